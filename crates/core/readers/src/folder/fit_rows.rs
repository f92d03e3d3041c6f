//! Activities of Garmin as text, as `FitCSVTool` writes them: in each row the names, values and units of a message. Its
//! records become the rows of a table.

use std::fmt::Write as _;

use super::table_text::bare_cells;
use crate::cells::Separator;

/// First names of columns.
const NAMES: &[u8] = b"Type,Local Number,Message,";
/// Degrees of a semicircle.
const SEMICIRCLE: f64 = 180.0 / 2_147_483_648.0;
/// Seconds since 1970 at which times begin: 1989-12-31.
const EPOCH: f64 = 631_065_600.0;
/// Fields of a record, of which the finer ones come first, with names of columns.
const FIELDS: [(&str, &[&str]); 6] = [
    ("time [unix s]", &["timestamp"]),
    ("latitude [deg]", &["position_lat"]),
    ("longitude [deg]", &["position_long"]),
    ("altitude msl [m]", &["enhanced_altitude", "altitude"]),
    ("speed over ground [m/s]", &["enhanced_speed", "speed"]),
    ("course over ground [deg]", &["heading"]),
];

/// The table of a text's records; `None` of any other text.
pub(super) fn of_fit_rows(text: &[u8]) -> Option<String> {
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    if !text.starts_with(NAMES) {
        return None;
    }
    let text = String::from_utf8_lossy(text);
    let mut table = FIELDS.map(|(name, _)| name).join(",");
    let mut count = 0;
    // A line for each line, so that lines keep their numbers.
    for line in text.lines().skip(1) {
        table.push('\n');
        let cells = bare_cells(line, Separator::Comma);
        if cells.first() != Some(&"Data") || cells.get(2) != Some(&"record") {
            continue;
        }
        let values = FIELDS.map(|(name, names)| value(&cells[3..], name, names));
        if values[0].is_none() {
            continue;
        }
        count += 1;
        for (index, value) in values.into_iter().enumerate() {
            if index > 0 {
                table.push(',');
            }
            if let Some(value) = value {
                let _ = write!(table, "{value:.9}");
            }
        }
    }
    table.push('\n');
    (count > 1).then_some(table)
}

/// The value of the first of those fields in the cells of a row, in the unit of the column `name`.
fn value(cells: &[&str], name: &str, fields: &[&str]) -> Option<f64> {
    let find = |wanted: &str| -> Option<f64> {
        let at = cells.chunks(3).find(|part| part[0] == wanted)?;
        at.get(1)?.parse().ok()
    };
    let value = fields.iter().find_map(|field| find(field))?;
    Some(match name {
        "time [unix s]" => value + EPOCH,
        "latitude [deg]" | "longitude [deg]" => value * SEMICIRCLE,
        _ => value,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_of_an_activity_are_rows() {
        let text = "Type,Local Number,Message,Field 1,Value 1,Units 1,\n\
             Definition,1,record,timestamp,1,,position_lat,1,,\n\
             Data,1,record,timestamp,\"1083492000\",s,position_lat,\"-403846230\",semicircles,position_long,\"219759160\",semicircles,altitude,\"12.0\",m,enhanced_altitude,\"12.4\",m,\n\
             Data,0,event,timestamp,\"1083492000\",s,\n\
             Data,1,record,timestamp,\"1083492001\",s,enhanced_speed,\"3.5\",m/s,\n";
        let table = of_fit_rows(text.as_bytes()).unwrap();
        let rows: Vec<&str> = table.lines().filter(|line| !line.is_empty()).collect();
        let numbers: Vec<&str> = rows[1].split(',').collect();
        // 2024-05-01 10:00:00 UTC.
        assert_eq!(numbers[0], "1714557600.000000000");
        assert!((numbers[1].parse::<f64>().unwrap() + 33.85).abs() < 1e-7);
        assert!((numbers[2].parse::<f64>().unwrap() - 18.42).abs() < 1e-7);
        assert_eq!(numbers[3], "12.400000000");
        assert!(rows[2].contains("3.5"));
        assert_eq!(table.lines().count(), text.lines().count());
        assert!(of_fit_rows(b"time,lat\n1,2\n").is_none());
    }
}
