//! Clocks of tables whose zone or unit stands in another column or nowhere, brought to what other tables have.

use std::borrow::Cow;

use super::table_text::{bare_cells, joined, name_separator, with_cell};
use crate::cells::{Separator, has_zone};

/// Columns of Garmin: day and time where the aircraft is, and hours from Greenwich.
const LOCAL: [&str; 3] = ["Lcl Date", "Lcl Time", "UTCOfst"];
/// Clock of Xsens in tenths of milliseconds, and what it is called in seconds.
const FINE: (&str, &str) = ("SampleTimeFine", "SampleTimeFine time [s]");
/// Time after which the clock of Xsens begins anew, seconds.
const FINE_TURN: f64 = 429_496.729_6;
/// Clocks of radios in hundredths of seconds: firmware's, and that of a script beside what it logs.
const HUNDREDTHS: [(&str, &[&str]); 2] = [
    ("tmr10ms", &[]),
    ("time", &["GPS_numSat", "GPS_coord[0]", "VSpd", "RxBt"]),
];
/// Their name in seconds.
const OF_RADIO: &str = "time of radio [s]";
/// Words of universal time.
const ZONES: [&str; 2] = ["utc", "gmt"];
/// Lines within which the names of columns stand.
const HEAD: usize = 40;

/// The text of a table with days and hours from Greenwich about its local times, dates about those of universal time, and
/// seconds for ticks of Xsens where no other column is a time.
pub(super) fn with_told_clocks(text: Cow<'_, [u8]>) -> Cow<'_, [u8]> {
    let head = text.split(|b| *b == b'\n').take(HEAD);
    let has = |line: &[u8], name: &str| {
        line.windows(name.len())
            .any(|w| w.eq_ignore_ascii_case(name.as_bytes()))
    };
    let found = head.enumerate().find_map(|(number, line)| {
        let is_local = LOCAL.iter().all(|name| has(line, name));
        let is_universal =
            has(line, "date") && has(line, "time") && ZONES.iter().any(|zone| has(line, zone));
        let is_of_radio = HUNDREDTHS
            .iter()
            .any(|(clock, beside)| has(line, clock) && beside.iter().all(|name| has(line, name)));
        (is_local || is_universal || has(line, FINE.0) || is_of_radio).then_some(number)
    });
    let Some(number) = found else {
        return text;
    };
    let changed = {
        let text = String::from_utf8_lossy(&text);
        with_zones(&text, number)
            .or_else(|| in_seconds(&text, number))
            .or_else(|| of_hundredths(&text, number))
    };
    changed.map_or(text, |changed| Cow::Owned(changed.into_bytes()))
}

/// Columns of those names.
fn columns<const N: usize>(
    names: &str,
    separator: Separator,
    wanted: [&str; N],
) -> Option<[usize; N]> {
    let names = bare_cells(names, separator);
    let found = wanted.map(|name| names.iter().position(|other| *other == name));
    found
        .iter()
        .all(Option::is_some)
        .then(|| found.map(|at| at.unwrap_or(0)))
}

/// The columns of date and time of day, and that of hours from Greenwich; without one they are in universal time.
fn clock(names: &str, separator: Separator) -> Option<(usize, usize, Option<usize>)> {
    if let Some([date, time, offset]) = columns(names, separator, LOCAL) {
        return Some((date, time, Some(offset)));
    }
    let mut found = [None; 2];
    let mut is_universal = false;
    for (at, name) in bare_cells(names, separator).into_iter().enumerate() {
        // Behind brackets stands how it is written: `UTC Date (yyyy-mm-dd)`.
        let bare = name
            .split(['(', '['])
            .next()
            .filter(|bare| !bare.is_empty());
        let has_form = name.contains(['y', 'Y', 'h', 'H']);
        let plain = bare
            .filter(|_| has_form)
            .unwrap_or(name)
            .to_lowercase()
            .replace(|c: char| !c.is_alphanumeric(), " ");
        let mut words: Vec<&str> = plain.split_whitespace().collect();
        let count = words.len();
        words.retain(|word| !ZONES.contains(word) && *word != "gps");
        let has_zone = words.len() < count && !plain.contains("gps");
        let of = match words[..] {
            ["date"] => 0,
            ["time"] => 1,
            _ => continue,
        };
        // Another clock beside it may be the one that the date belongs to.
        if found[of].replace(at).is_some() {
            return None;
        }
        is_universal |= has_zone;
    }
    found[0]
        .zip(found[1])
        .filter(|_| is_universal)
        .map(|(date, time)| (date, time, None))
}

fn with_zones(text: &str, number: usize) -> Option<String> {
    let names = text.lines().nth(number)?;
    let separator = name_separator(names);
    let (date, time, offset) = clock(names, separator)?;
    if has_late_dates(text.lines().skip(number + 1), separator, (date, time)) {
        return None;
    }
    let line = |(index, line): (usize, &str)| {
        let places = separator.places(line);
        let cell = |at: usize| places.get(at).map_or("", |place| &line[place.clone()]);
        let zone = offset.map_or("Z", cell);
        let told = format!("{} {}{zone}", cell(date), cell(time));
        if index <= number || cell(date).is_empty() || !cell(time).contains(':') || !has_zone(&told)
        {
            return line.to_owned();
        }
        with_cell(line, &places[time], &told)
    };
    Some(joined(text.lines().enumerate().map(line)))
}

/// Whether the date stays as it is over midnight: it is that of the beginning then.
fn has_late_dates<'a>(
    rows: impl Iterator<Item = &'a str>,
    separator: Separator,
    (date, time): (usize, usize),
) -> bool {
    let mut before: Option<(&str, u8)> = None;
    for row in rows {
        let cells = bare_cells(row, separator);
        let hour = cells
            .get(time)
            .and_then(|cell| cell.split(':').next()?.parse().ok());
        let Some((date, hour)) = cells.get(date).copied().zip(hour) else {
            continue;
        };
        if hour == 0 && before == Some((date, 23)) {
            return true;
        }
        before = Some((date, hour));
    }
    false
}

/// Seconds for the hundredths that radios count.
fn of_hundredths(text: &str, number: usize) -> Option<String> {
    let names = text.lines().nth(number)?;
    let separator = name_separator(names);
    let cells = bare_cells(names, separator);
    let has = |name: &&str| cells.contains(name);
    let clock = HUNDREDTHS.iter().find_map(|(clock, beside)| {
        let at = cells.iter().position(|name| name == clock)?;
        beside.iter().all(has).then_some(at)
    })?;
    let line = |(index, line): (usize, &str)| {
        let places = separator.places(line);
        let Some(place) = places.get(clock).filter(|_| index >= number) else {
            return line.to_owned();
        };
        if index == number {
            return with_cell(line, place, OF_RADIO);
        }
        match line[place.clone()].parse::<f64>() {
            Ok(hundredths) => with_cell(line, place, &format!("{:.2}", hundredths / 100.0)),
            Err(_) => line.to_owned(),
        }
    };
    Some(joined(text.lines().enumerate().map(line)))
}

fn in_seconds(text: &str, number: usize) -> Option<String> {
    let names = text.lines().nth(number)?;
    let separator = name_separator(names);
    let [clock] = columns(names, separator, [FINE.0])?;
    let is_time = |name: &str| {
        let name = name.to_lowercase();
        name.contains("utc")
            || name.contains("time") && !name.contains("fine") && !name.contains("coarse")
    };
    if bare_cells(names, separator).into_iter().any(is_time) {
        return None;
    }
    let (mut last, mut turned) = (f64::NEG_INFINITY, 0.0);
    let line = |(index, line): (usize, &str)| {
        if index == number {
            return line.replacen(FINE.0, FINE.1, 1);
        }
        let places = separator.places(line);
        let place = places.get(clock).filter(|_| index > number);
        let ticks = place.and_then(|place| Some((place, line[place.clone()].parse::<f64>().ok()?)));
        let Some((place, ticks)) = ticks else {
            return line.to_owned();
        };
        let seconds = ticks / 1e4;
        if seconds < last - FINE_TURN / 2.0 {
            turned += FINE_TURN;
        }
        last = seconds;
        with_cell(line, place, &format!("{:.4}", seconds + turned))
    };
    Some(joined(text.lines().enumerate().map(line)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(text: &str) -> String {
        let found = with_told_clocks(Cow::Borrowed(text.as_bytes()));
        String::from_utf8(found.into_owned()).unwrap()
    }

    #[test]
    fn local_times_have_the_hours_that_stand_beside_them() {
        let table = "#airframe_info\n  Lcl Date, Lcl Time, UTCOfst, Latitude\n2024-05-01, 14:00:00, -04:00, 1.5\n , , , \n";
        let right = "#airframe_info\n  Lcl Date, Lcl Time, UTCOfst, Latitude\n2024-05-01, 2024-05-01 14:00:00-04:00, -04:00, 1.5\n , , , \n";
        assert_eq!(told(table), right);
        let table = "UTC Date;UTC Time;Latitude\n13.05.2024;10:00:00.5;1\n;10:00:01.0;2\n";
        let right =
            "UTC Date;UTC Time;Latitude\n13.05.2024;13.05.2024 10:00:00.5Z;1\n;10:00:01.0;2\n";
        assert_eq!(told(table), right);
        let table = "\"UTC Date\",\"Note\",\"UTC Time\"\n\"2024-05-13\",\"a, b\",\"10:00:00.5\"\n";
        let right = "\"UTC Date\",\"Note\",\"UTC Time\"\n\"2024-05-13\",\"a, b\",\"2024-05-13 10:00:00.5Z\"\n";
        assert_eq!(told(table), right);
        for other in [
            "Date,Time,lat\n2024-05-13,10:00:00,1\n",
            "date_utc,time_utc,time,lat\n2024-05-13,10:00:00,1,1\n",
        ] {
            assert_eq!(told(other), other);
        }
    }

    #[test]
    fn hundredths_of_radios_are_seconds() {
        let table = "time,GPS_numSat,GPS_coord[0],GPS_coord[1],VSpd,RxBt\n12345,9,47,8,0,16\n";
        let right = "time of radio [s],GPS_numSat,GPS_coord[0],GPS_coord[1],VSpd,RxBt\n123.45,9,47,8,0,16\n";
        assert_eq!(told(table), right);
        assert_eq!(
            told("tmr10ms,GPS\n100,47 8\n"),
            "time of radio [s],GPS\n1.00,47 8\n"
        );
        let other = "time,GPS_numSat,GPS_coord[0]\n12345,9,47\n";
        assert_eq!(told(other), other);
    }

    #[test]
    fn ticks_of_xsens_are_seconds_where_no_other_column_is_a_time() {
        let table = "PacketCounter,SampleTimeFine,Roll\n1,4294960000,0.5\n2,2704,0.6\n";
        let right =
            "PacketCounter,SampleTimeFine time [s],Roll\n1,429496.0000,0.5\n2,429497.0000,0.6\n";
        assert_eq!(told(table), right);
        let dated = "SampleTimeFine,UTC_Hour\n10000,10\n";
        assert_eq!(told(dated), dated);
        assert_eq!(told("a,b\n1,2\n"), "a,b\n1,2\n");
    }
}
