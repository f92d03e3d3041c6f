//! Files of VBOX data loggers: text with sections in brackets, whose places are in minutes with west positive.

use super::table_text::joined;

/// Bytes in which the sections before the rows stand.
const HEAD: usize = 1 << 14;

/// The rows of a `.vbo` file as a table: places in degrees with east positive, and names that say their units. The manuals of
/// `RaceLogic` have it: minutes of arc, longitude positive to the west, `heading` over ground, `height` above sea level.
pub(super) fn of_vbo(text: &[u8]) -> Option<String> {
    let head = String::from_utf8_lossy(&text[..text.len().min(HEAD)]).to_lowercase();
    let has = |section: &str| head.lines().any(|line| line.trim() == section);
    if !has("[column names]") || !has("[data]") {
        return None;
    }
    // The section before lists them in words, with their units: `velocity kmh`.
    let unit = |channel: &str| {
        let mut lines = head.lines().map(str::trim);
        let unit = lines.find_map(|line| line.strip_prefix(channel));
        unit.map_or("km/h", str::trim).to_owned()
    };
    let (speed, climb) = (unit("velocity "), unit("vertical velocity "));
    let mut section = String::new();
    let mut names: Vec<String> = Vec::new();
    let line = |line: &str| {
        let line = line.trim();
        if line.starts_with('[') {
            section = line.to_lowercase();
            return String::new();
        }
        if section == "[column names]" && !line.is_empty() {
            names = line.split_whitespace().map(str::to_lowercase).collect();
            let named = names.iter().map(|name| match name.as_str() {
                "lat" | "latitude" => "latitude [deg]".to_owned(),
                "long" | "longitude" => "longitude [deg]".to_owned(),
                "velocity" => format!("ground speed [{speed}]"),
                "heading" => "course [deg]".to_owned(),
                "height" => "altitude msl [m]".to_owned(),
                "vert-vel" => format!("vertical speed [{climb}]"),
                other => other.to_owned(),
            });
            return named.collect::<Vec<String>>().join(",");
        }
        if section != "[data]" {
            return String::new();
        }
        let degrees = |minutes: &str, sign: f64| {
            let number = minutes.parse::<f64>();
            number.map_or_else(
                |_| minutes.to_owned(),
                |m| format!("{:.10}", sign * m / 60.0),
            )
        };
        let cells = line.split_whitespace().enumerate();
        let cells = cells.map(|(at, cell)| match names.get(at).map(String::as_str) {
            Some("lat" | "latitude") => degrees(cell, 1.0),
            Some("long" | "longitude") => degrees(cell, -1.0),
            _ => cell.to_owned(),
        });
        cells.collect::<Vec<String>>().join(",")
    };
    Some(joined(String::from_utf8_lossy(text).lines().map(line)))
}
