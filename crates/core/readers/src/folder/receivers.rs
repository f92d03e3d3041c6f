//! Tables of satellite receivers whose rows or names other tables do not have, brought to what those have: line by line, so
//! that lines keep their numbers.

use std::borrow::Cow;

use nalgebra::Vector3;
use pilotage_base::frames::Ellipsoid;

use super::fit_rows::of_fit_rows;
use super::receiver_dates::with_receiver_dates;
use super::solutions::{missing_names, of_baselines};
use super::table_text::{
    bare_cells, joined, name_separator, solution_cells, solution_separator, with_cell,
};
use super::told_clocks::with_told_clocks;
use super::utm_places::with_places_of_utm;
use super::variation::with_true_directions;
use super::vbo::of_vbo;

/// Names of RTKLIB over degrees, minutes and seconds in three cells, and names for each of them.
const THREE_CELLS: [(&str, [&str; 3]); 2] = [
    ("latitude(d'\")", ["lat_deg", "lat_min", "lat_sec"]),
    ("longitude(d'\")", ["lon_deg", "lon_min", "lon_sec"]),
];
/// Name of RTKLIB over the first of three geocentric coordinates, and of a velocity along their axes.
const GEOCENTRIC: &str = "x-ecef(m)";
const GEOCENTRIC_VELOCITY: &str = "vx(m/s)";

/// The text of a table with cells and names as other tables have them.
pub(super) fn plain(text: Cow<'_, [u8]>) -> Cow<'_, [u8]> {
    let text = if text.contains(&0) {
        // Loggers of Columbus fill their cells up with zeros.
        Cow::Owned(
            text.iter()
                .map(|b| if *b == 0 { b' ' } else { *b })
                .collect(),
        )
    } else {
        text
    };
    if text.starts_with(b"$FLYS,") {
        return Cow::Owned(of_flysight(&String::from_utf8_lossy(&text)).into_bytes());
    }
    if let Some(rows) = of_vbo(&text) {
        return Cow::Owned(rows.into_bytes());
    }
    if let Some(records) = of_fit_rows(&text) {
        return Cow::Owned(records.into_bytes());
    }
    if let Some(fixes) = of_gnss_logger(&text) {
        return Cow::Owned(fixes.into_bytes());
    }
    if let Some(names) = missing_names(&text) {
        return Cow::Owned([names.as_bytes(), &text].concat());
    }
    if !text.starts_with(b"%") {
        let placed = with_places_of_utm(with_both_names(text));
        return with_true_directions(with_told_clocks(with_receiver_dates(placed)));
    }
    let names = |name: &str| {
        let head = &text[..text.len().min(1 << 14)];
        head.split(|b| *b == b'\n')
            .take_while(|line| line.starts_with(b"%"))
            .any(|line| String::from_utf8_lossy(line).contains(name))
    };
    if names(THREE_CELLS[0].0) {
        return Cow::Owned(with_names_of_three(&String::from_utf8_lossy(&text)).into_bytes());
    }
    if names(GEOCENTRIC) {
        return Cow::Owned(geodetic(&String::from_utf8_lossy(&text)).into_bytes());
    }
    match of_baselines(&String::from_utf8_lossy(&text)) {
        Some(places) => Cow::Owned(places.into_bytes()),
        None => text,
    }
}

/// Rows that tell whether both numbers of a place stand below one name.
const ROWS: usize = 20;

/// Names for both cells of a place, where radios write one: firmware of Ethos and of `OpenTX` 2.1 has `GPS` over latitude and
/// longitude, and every name behind it over the cell before its own.
fn with_both_names(text: Cow<'_, [u8]>) -> Cow<'_, [u8]> {
    let head = String::from_utf8_lossy(&text[..text.len().min(1 << 14)]);
    let mut lines = head.lines();
    let names = lines.next().unwrap_or("");
    let separator = name_separator(names);
    let cells = bare_cells(names, separator);
    let Some(at) = cells.iter().position(|name| *name == "GPS") else {
        return text;
    };
    let is_shifted = |row: &str| {
        let row = bare_cells(row, separator);
        let degrees = |at: usize, most: f64| {
            let cell = row.get(at).filter(|cell| cell.contains('.'));
            let number = cell.and_then(|cell| cell.parse::<f64>().ok());
            number.is_some_and(|number| number.abs() <= most)
        };
        row.len() == cells.len() + 1 && degrees(at, 90.0) && degrees(at + 1, 180.0)
    };
    let rows: Vec<bool> = lines.take(ROWS).map(is_shifted).collect();
    if 2 * rows.iter().filter(|row| **row).count() <= rows.len() {
        return text;
    }
    let seam = char::from(separator.byte());
    let both = format!("GPS latitude{seam}GPS longitude");
    let named = with_cell(names, &separator.places(names)[at], &both);
    let rest = &text[names.len()..];
    Cow::Owned([named.as_bytes(), rest].concat())
}

/// The fixes of Google's `GnssLogger`, whose file has the names of each kind of row behind a `#`.
fn of_gnss_logger(text: &[u8]) -> Option<String> {
    let head = &text[..text.len().min(1 << 12)];
    let is_name = |line: &[u8]| line.starts_with(b"# Fix,Provider,");
    if !text.starts_with(b"#") || !head.split(|b| *b == b'\n').any(is_name) {
        return None;
    }
    let text = String::from_utf8_lossy(text);
    let line = |line: &str| {
        let names = line.strip_prefix("# ").unwrap_or(line);
        names
            .strip_prefix("Fix,")
            .map_or_else(String::new, str::to_owned)
    };
    Some(joined(text.lines().map(line)))
}

/// The places of a `FlySight` 2: names and units stand behind `$COL,GNSS` and `$UNIT,GNSS`, rows behind `$GNSS`.
fn of_flysight(text: &str) -> String {
    let line = |line: &str| {
        let cut = |begin: &str| line.strip_prefix(begin).map(str::to_owned);
        cut("$COL,GNSS,")
            .or_else(|| cut("$UNIT,GNSS,"))
            .or_else(|| cut("$GNSS,"))
            .unwrap_or_default()
    };
    joined(text.lines().map(line))
}

/// A name for each cell of angles in degrees, minutes and seconds.
fn with_names_of_three(text: &str) -> String {
    let line = |line: &str| {
        if !line.starts_with('%') {
            return line.to_owned();
        }
        let separator = solution_separator(line);
        THREE_CELLS
            .iter()
            .fold(line.to_owned(), |line, (name, three)| {
                line.replace(name, &three.join(separator))
            })
    };
    joined(text.lines().map(line))
}

/// Latitude, longitude and height for geocentric coordinates; velocities along their axes are left out.
fn geodetic(text: &str) -> String {
    let (mut separator, mut names) = (" ", Vec::new());
    let line = |line: &str| {
        if line.starts_with('%') && line.contains(GEOCENTRIC) {
            separator = solution_separator(line);
            names = solution_cells(line.trim_start_matches('%'), separator);
            let velocity = names.iter().position(|name| name == GEOCENTRIC_VELOCITY);
            let mut told = names[..velocity.unwrap_or(names.len())].to_vec();
            if let Some(x) = told.iter().position(|name| name == GEOCENTRIC)
                && x + 3 <= told.len()
            {
                let places = ["latitude(deg)", "longitude(deg)", "height(m)"];
                told.splice(x..x + 3, places.map(str::to_owned));
            }
            return format!("%{}", told.join(separator));
        }
        let Some(x) = names.iter().position(|name| name == GEOCENTRIC) else {
            return line.to_owned();
        };
        let mut cells = solution_cells(line, separator);
        // Date and time of day have one name.
        let more = cells.len().saturating_sub(names.len());
        let at = x + more;
        let number = |index: usize| cells.get(index)?.parse::<f64>().ok();
        let Some(place) = number(at).zip(number(at + 1)).zip(number(at + 2)) else {
            return line.to_owned();
        };
        let ((x, y), z) = place;
        let (latitude, longitude, height) = Ellipsoid::WGS84.geodetic(&Vector3::new(x, y, z));
        let [latitude, longitude] = [latitude, longitude].map(f64::to_degrees);
        let place = [
            format!("{latitude:.10}"),
            format!("{longitude:.10}"),
            format!("{height:.4}"),
        ];
        cells.splice(at..at + 3, place);
        if let Some(velocity) = names.iter().position(|name| name == GEOCENTRIC_VELOCITY) {
            cells.truncate(velocity + more);
        }
        cells.join(separator)
    };
    joined(text.lines().map(line))
}
