//! Flight records of gliders (IGC): its fixes (B records), as a flight.

use std::sync::Arc;

use crate::cells::days_since_1970;
use crate::folder::{FlightFolder, FolderError, decoded};
use crate::text_tables::{first_flight, flight_of_table, table};
use pilotage_base::files::FileSet;
use pilotage_base::text::{by_count, utc_text};

const DAY: f64 = 86_400.0;
/// Two digits of a year from this one on are of the century before.
const CENTURY: i64 = 80;
/// Columns behind the time; the pressure of the standard atmosphere tells the first height.
const COLUMNS: [&str; 4] = [
    "latitude [deg]",
    "longitude [deg]",
    "pressure altitude [m]",
    "gps altitude [m]",
];

/// A fix: seconds of the day and the values of [`COLUMNS`].
type Fix = (f64, [Option<f64>; 4]);

/// Whether the first bytes of a file are a flight record: who recorded it in its first line, and a date or a fix behind it.
pub fn is_igc(head: &[u8]) -> bool {
    let head = decoded(head);
    let text = String::from_utf8_lossy(&head);
    let mut lines = text
        .lines()
        .map(str::trim_end)
        .filter(|line| !line.is_empty());
    let is_recorder = lines.next().is_some_and(|line| {
        line.trim_start_matches('\u{feff}').starts_with('A') && !line.contains(',')
    });
    is_recorder && lines.any(|line| date(line).is_some() || fix(line).is_some())
}

/// The flight that the first flight record among `files` tells of; `None` if there is none. Others are left out with a note.
///
/// # Errors
/// A record of which no flight can be made.
pub fn flight_of_record(files: &Arc<dyn FileSet>) -> Result<Option<FlightFolder>, FolderError> {
    let because = "it is a recording of its own";
    first_flight(files.as_ref(), ".igc", because, read_igc)
}

/// The flight that a record tells of; `None` if it has fewer than two fixes. Heights of the satellite receiver are above the
/// ellipsoid, unless the record says that they are above the geoid.
///
/// # Errors
/// Fixes of which no flight can be made.
///
/// ```
/// use pilotage_readers::igc::read_igc;
///
/// // 47°22.272' N, 8°32.526' E; four seconds later 0.006' farther north, which are 11.1 m.
/// let text = "AXXX001\nHFDTE010524\nB1000004722272N00832526EA0040000450\nB1000044722278N00832526EA0040100451\n";
/// let folder = read_igc("a.igc", text.as_bytes())?.ok_or("no two fixes")?;
/// let truth = folder.flight.truth.ok_or("no track")?;
/// assert!(((truth.states[1].position - truth.states[0].position).norm() - 11.1).abs() < 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_igc(name: &str, bytes: &[u8]) -> Result<Option<FlightFolder>, FolderError> {
    let bytes = decoded(bytes);
    let text = String::from_utf8_lossy(&bytes);
    let mut fixes: Vec<Fix> = Vec::new();
    let (mut day, mut damaged, mut is_geoid) = (None, 0, false);
    for line in text.lines().map(str::trim_end) {
        match line.as_bytes().first() {
            Some(b'B') => match fix(line) {
                Some(fix) => fixes.push(fix),
                None => damaged += 1,
            },
            Some(b'H') => {
                day = day.or_else(|| date(line));
                is_geoid |= line.starts_with("HFALG") && line.to_uppercase().ends_with("GEO");
            }
            _ => {}
        }
    }
    if fixes.len() < 2 {
        return Ok(None);
    }
    let mut findings = Vec::new();
    if damaged > 0 {
        findings.push(format!(
            "{damaged} {} damaged",
            by_count(
                damaged,
                "line that begins as a fix was left out: it is",
                "lines that begin as fixes were left out: they are"
            )
        ));
    }
    if !is_geoid {
        findings.push(
            "the receiver's heights in a flight record are above the ellipsoid of WGS 84, which lies up to 107 m from sea level"
                .to_owned(),
        );
    }
    findings.extend(leave_out_noughts(&mut fixes));
    let mut turned = 0.0;
    let mut last = fixes[0].0;
    let rows: Vec<_> = fixes
        .into_iter()
        .map(|(second, values)| {
            // Over midnight.
            if last - second > 0.5 * DAY {
                turned += DAY;
            }
            last = second;
            let second = second + turned;
            let time = match day {
                Some(day) => utc_text(day as f64 * DAY + second),
                None => format!("{second:.3}"),
            };
            (time, values)
        })
        .collect();
    let time = if day.is_some() { "time" } else { "time [s]" };
    flight_of_table(name, table(time, COLUMNS, &rows), findings)
}

/// Takes out heights that are nought in all fixes: recorders write them so where they have no sensor of pressure, or no height
/// of the receiver. Says so.
fn leave_out_noughts(fixes: &mut [Fix]) -> Vec<String> {
    let mut told = Vec::new();
    for (column, of) in [(2, "pressure altitudes"), (3, "altitudes of the receiver")] {
        let mut known = fixes.iter().filter_map(|(_, values)| values[column]);
        if known.clone().next().is_some() && known.all(|height| height == 0.0) {
            for (_, values) in fixes.iter_mut() {
                values[column] = None;
            }
            told.push(format!("all {of} are 0: the recorder did not measure them"));
        }
    }
    told
}

/// Days since 1970 of a line `HFDTE010524` or `HFDTEDATE:010524,01`.
fn date(line: &str) -> Option<i64> {
    let rest = line
        .strip_prefix("HFDTE")
        .or_else(|| line.strip_prefix("HODTE"))?;
    let rest = rest
        .trim_start_matches("DATE")
        .trim_start_matches([':', ' ']);
    let part = |at: usize| rest.get(at..at + 2)?.parse::<i64>().ok();
    let (day, month, year) = (part(0)?, part(2)?, part(4)?);
    let is_date = (1..=31).contains(&day) && (1..=12).contains(&month) && year >= 0;
    let year = year + if year < CENTURY { 2000 } else { 1900 };
    is_date.then(|| days_since_1970(year, month, day))
}

/// A fix of `BhhmmssDDMMmmmNDDDMMmmmEVPPPPPGGGGG`; `V` beside its place says that it has no height of the receiver.
fn fix(line: &str) -> Option<Fix> {
    let line = line.strip_prefix('B').filter(|line| line.is_ascii())?;
    let number = |from: usize, to: usize| {
        let digits = line.get(from..to)?;
        let is_number = digits.bytes().all(|b| b.is_ascii_digit() || b == b'-');
        digits.parse::<f64>().ok().filter(|_| is_number)
    };
    let angle = |from: usize, degrees: usize, most: f64, letters: [&str; 2]| {
        let whole = number(from, from + degrees)?;
        let minutes = number(from + degrees, from + degrees + 5)? / 1000.0;
        let sign = match line.get(from + degrees + 5..from + degrees + 6)? {
            letter if letter == letters[0] => 1.0,
            letter if letter == letters[1] => -1.0,
            _ => return None,
        };
        let angle = whole + minutes / 60.0;
        (minutes < 60.0 && angle <= most).then_some(sign * angle)
    };
    let (hours, minutes, seconds) = (number(0, 2)?, number(2, 4)?, number(4, 6)?);
    let is_time = hours < 24.0 && minutes < 60.0 && seconds < 61.0;
    let (latitude, longitude) = (
        angle(6, 2, 90.0, ["N", "S"])?,
        angle(14, 3, 180.0, ["E", "W"])?,
    );
    let validity = line.get(23..24)?;
    let (pressure, receiver) = (number(24, 29)?, number(29, 34)?);
    let has_height = validity == "A";
    (is_time && (has_height || validity == "V")).then(|| {
        let values = [
            Some(latitude),
            Some(longitude),
            Some(pressure),
            Some(receiver).filter(|_| has_height),
        ];
        (3600.0 * hours + 60.0 * minutes + seconds, values)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_flight::ChannelName;

    /// A climb of a metre a second, a fix every second from 23:59:50 on, westwards and southwards.
    fn record(head: &str, validity: &str) -> String {
        let fix = |i: u32| {
            let second = 86_390 + i;
            let (h, m, s) = (second / 3600 % 24, second / 60 % 60, second % 60);
            format!(
                "B{h:02}{m:02}{s:02}3351{:03}S01825{:03}W{validity}{:05}{:05}002\r\n",
                200 + 5 * i,
                100 + 4 * i,
                400 + i,
                450 + i
            )
        };
        format!(
            "AXCT123\r\n{head}\r\nI013638FXA\r\n{}GABC\r\n",
            (0..40).map(fix).collect::<String>()
        )
    }

    #[test]
    fn fixes_of_a_flight_record_are_a_flight_over_midnight() {
        for head in ["HFDTE310124", "HFDTEDATE:310124,01", "HFDTEDATE: 310124"] {
            let text = record(head, "A");
            assert!(is_igc(text.as_bytes()));
            let folder = read_igc("a.igc", text.as_bytes()).unwrap().unwrap();
            let origin = folder.flight.frame_on_globe.unwrap().origin;
            assert!((origin.latitude.to_degrees() + 33.0 + 51.2 / 60.0).abs() < 1e-9);
            assert!((origin.longitude.to_degrees() + 18.0 + 25.1 / 60.0).abs() < 1e-9);
            let truth = folder.flight.truth.as_ref().unwrap();
            let (first, last) = (&truth.states[0], truth.states.last().unwrap());
            assert!((last.time - first.time - 39.0).abs() < 1e-9);
            let heights = folder.flight.channel(ChannelName::GpsHeight).unwrap();
            assert_eq!(heights.values.last(), Some(&489.0));
            assert!(
                folder.notes.iter().any(|note| note.contains("ellipsoid")),
                "{:?}",
                folder.notes
            );
        }
    }

    #[test]
    fn a_record_without_heights_of_the_receiver_has_those_of_pressure() {
        let folder = read_igc("a.igc", record("HFDTE310124", "V").as_bytes())
            .unwrap()
            .unwrap();
        assert!(folder.flight.channel(ChannelName::GpsHeight).is_none());
    }

    #[test]
    fn heights_that_are_nought_in_all_fixes_were_not_measured() {
        let text = |fixes: [&str; 2]| format!("AXXX001\nHFDTE010524\n{}\n", fixes.join("\n"));
        let read = |fixes| read_igc("a.igc", text(fixes).as_bytes()).unwrap().unwrap();
        let folder = read([
            "B1000004722272N00832526EA0000000450",
            "B1000044722278N00832526EA0000001450",
        ]);
        let height = |name| folder.flight.channel(name).map(|c| c.values.clone());
        assert_eq!(height(ChannelName::BarometricHeight), None);
        let above_ground = height(ChannelName::HeightAboveGround);
        assert_eq!(above_ground, Some(vec![0.0, 1000.0]));
        let is_told = |note: &String| note.starts_with("all pressure altitudes are 0");
        assert!(folder.notes.iter().any(is_told), "{:?}", folder.notes);
        // A receiver without heights.
        let folder = read([
            "B1000004722272N00832526EA0040000000",
            "B1000044722278N00832526EA0041000000",
        ]);
        let height = |name| folder.flight.channel(name).map(|c| c.values.clone());
        assert_eq!(height(ChannelName::GpsHeight), None);
        let above_ground = height(ChannelName::HeightAboveGround);
        assert_eq!(above_ground, Some(vec![0.0, 10.0]));
    }

    #[test]
    fn damaged_fixes_are_left_out_and_told_and_other_text_is_no_record() {
        let text = record("HFDTE310124", "A").replace("B2359523351", "B235952335x");
        let folder = read_igc("a.igc", text.as_bytes()).unwrap().unwrap();
        assert!(
            folder
                .notes
                .iter()
                .any(|note| note.starts_with("1 line that")),
            "{:?}",
            folder.notes
        );
        for text in ["", "A\n", "About, B\nHFDTE\n", "time,lat,lon\n1,2,3\n"] {
            assert!(!is_igc(text.as_bytes()), "{text}");
            assert!(read_igc("a.igc", text.as_bytes()).unwrap().is_none());
        }
    }
}
