//! Date and time of a receiver beside a clock of its own, in columns of their own: both in one column.

use std::borrow::Cow;

use super::table_text::{bare_cells, name_separator, with_columns_behind};
use crate::cells::{Moment, date_and_time};

/// Name of the column that is added.
pub(crate) const RECEIVER_DATE: &str = "gps date and time supposed utc";
/// Lines within which the names of columns stand.
const HEAD: usize = 40;
/// Names of the parts of a date and time, behind the word for the receiver.
const PARTS: [&[&str]; 6] = [
    &["year", "yr"],
    &["month", "mon"],
    &["day"],
    &["hour", "hours", "hr"],
    &["minute", "minutes", "min"],
    &["second", "seconds", "sec"],
];

/// The columns that say the date and time.
enum DateColumns {
    Parts([usize; 6]),
    Texts(usize, usize),
}

/// The text of a table with the date and time of the receiver in a column behind its own, where it has another clock.
pub(super) fn with_receiver_dates(text: Cow<'_, [u8]>) -> Cow<'_, [u8]> {
    let says = |line: &[u8]| {
        let line = String::from_utf8_lossy(line).to_lowercase();
        let is_receiver = line.contains("gps") || line.contains("gnss");
        is_receiver && (line.contains("date") || line.contains("year"))
    };
    let mut head = text.split(|b| *b == b'\n').take(HEAD);
    let Some(number) = head.position(says) else {
        return text;
    };
    let changed = changed(&String::from_utf8_lossy(&text), number);
    changed.map_or(text, |changed| Cow::Owned(changed.into_bytes()))
}

/// The words of a name of the receiver's, without that for it.
fn said(name: &str) -> Option<String> {
    let name = name.trim_start_matches(['#', '%']).trim().to_lowercase();
    let name = name.replace(['_', '.', '-', ' '], "");
    let rest = name
        .strip_prefix("gps")
        .or_else(|| name.strip_prefix("gnss"))?;
    Some(rest.to_owned())
}

fn changed(text: &str, number: usize) -> Option<String> {
    let names = text.lines().nth(number)?;
    let separator = name_separator(names);
    let cells = bare_cells(names, separator);
    let find = |wanted: &[&str]| {
        let is_it = |name: &&str| said(name).is_some_and(|rest| wanted.contains(&rest.as_str()));
        cells.iter().position(is_it)
    };
    let parts = PARTS.map(find);
    let columns = if parts.iter().all(Option::is_some) {
        DateColumns::Parts(parts.map(|at| at.unwrap_or(0)))
    } else {
        DateColumns::Texts(
            find(&["date", "dateutc"])?,
            find(&["time", "timeutc", "clock"])?,
        )
    };
    // Without another clock these columns are the time themselves.
    let is_clock = |name: &&str| {
        let name = name.to_lowercase();
        said(&name).is_none() && (name.contains("time") || name == "t" || name.contains("millis"))
    };
    if !cells.iter().any(is_clock) {
        return None;
    }
    let moment = |cells: &[&str]| {
        let told = match &columns {
            DateColumns::Parts(parts) => {
                let [year, month, day, hour, minute, second] = parts.map(|at| cells[at]);
                let whole = |cell: &str| cell.parse::<f64>().ok().filter(|n| n.fract() == 0.0);
                let year =
                    whole(year).map(|year| if year < 100.0 { year + 2000.0 } else { year })?;
                let [month, day, hour, minute] =
                    [whole(month)?, whole(day)?, whole(hour)?, whole(minute)?];
                let second: f64 = second.parse().ok()?;
                format!("{year:04}-{month:02}-{day:02} {hour:02}:{minute:02}:{second:06.3}")
            }
            DateColumns::Texts(date, time) => {
                let (date, time) = (cells[*date], cells[*time]);
                if !time.contains(':') || !date.contains(['-', '/', '.']) {
                    return None;
                }
                format!("{date} {time}")
            }
        };
        matches!(date_and_time(&told), Some(Moment::Absolute(..))).then_some(told)
    };
    let cell = |cells: &[&str]| Some([moment(cells)?]);
    with_columns_behind(text, number, [RECEIVER_DATE], cell)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn date_and_time_of_a_receiver_stand_in_one_column_beside_another_clock() {
        for (names, cells, right) in [
            (
                "timestamp,lat,gps_date,gps_time",
                "12,47,2024-05-01,10:00:00.5",
                "2024-05-01 10:00:00.5",
            ),
            (
                "millis,lat,GPS_year,GPS_month,GPS_day,GPS_hour,GPS_minute,GPS_second",
                "12,47,24,5,1,10,0,7.25",
                "2024-05-01 10:00:07.250",
            ),
        ] {
            let text = format!("{names}\n{cells}\n");
            let found = with_receiver_dates(Cow::Borrowed(text.as_bytes()));
            let found = String::from_utf8(found.into_owned()).unwrap();
            assert_eq!(found.lines().nth(1).unwrap(), format!("{cells},{right}"));
        }
        for other in [
            "gps_date,gps_time,lat\n2024-05-01,10:00:00,47\n",
            "timestamp,gps_date,lat\n1,2024-05-01,47\n",
        ] {
            assert_eq!(
                with_receiver_dates(Cow::Borrowed(other.as_bytes())),
                other.as_bytes()
            );
        }
    }
}
