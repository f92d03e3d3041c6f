//! The format of a file, by its name and content.

use serde_json::{Map, Value};

use super::csv_bare::is_bare;
use super::csv_preface::preface;
use super::inav::is_inav;
use super::old_mission::is_mission;
use super::{Format, wpml};

impl Format {
    /// The format of a file, by its content first and its name where that leaves it open.
    pub fn of(name: &str, bytes: &[u8]) -> Option<Self> {
        if bytes.starts_with(b"PK\x03\x04") {
            let is_named = Self::of_name(name) == Some(Self::Kmz);
            return match () {
                () if wpml::is_zip(bytes) => Some(Self::Wpml),
                () if is_named || holds_kml(bytes) => Some(Self::Kmz),
                () => None,
            };
        }
        let head = String::from_utf8_lossy(&bytes[..bytes.len().min(4096)]);
        // A sequence of GeoJSON begins with the separator of its records.
        let head = head.trim_start_matches(['\u{feff}', '\u{1e}']).trim_start();
        if let Some(format) = Self::all().find(|format| format.begins(head)) {
            return Some(format);
        }
        if head.starts_with('<') {
            return match () {
                () if wpml::is_text(head) => Some(Self::Wpml),
                () if head.contains("<gpx") || head.contains("<LittleNavmap") => Some(Self::Gpx),
                () if is_inav(head) => Some(Self::Plan),
                () if head.contains("<kml") || head.contains(":kml") => Some(Self::Kml),
                () => Self::of_name(name).filter(|f| matches!(f, Self::Kml | Self::Gpx)),
            };
        }
        if head.starts_with('{') {
            let text = String::from_utf8_lossy(bytes);
            let has = |member: &str| text.contains(member);
            // The second is a mission of QGroundControl before there were plans.
            let is_plan =
                (has("\"fileType\"") || has("\"MAV_AUTOPILOT\"")) && !has("\"FeatureCollection\"");
            // Large files are parsed only where they may be one.
            let is_old_mission = || {
                has("\"items\"")
                    && serde_json::from_str::<Map<String, Value>>(&text)
                        .is_ok_and(|members| is_mission(&members))
            };
            return match Self::of_name(name) {
                _ if is_inav(head) => Some(Self::Plan),
                Some(Self::Plan) => Some(Self::Plan),
                _ if is_plan || is_old_mission() => Some(Self::Plan),
                _ => Some(Self::GeoJson),
            };
        }
        if is_inav(head) {
            return Some(Self::Plan);
        }
        let named = Self::of_name(name);
        let first_line = preface(head).table.lines().next().unwrap_or("");
        let is_table = [',', ';', '\t'].iter().any(|c| first_line.contains(*c));
        match named {
            Some(Self::Waypoints) if is_table || is_bare(head) => Some(Self::Csv),
            Some(named) => Some(named),
            // No text has zeros.
            None if head.contains('\0') => None,
            None => (is_table || is_bare(head)).then_some(Self::Csv),
        }
    }
}

/// Whether the list of a zip has a document of KML.
fn holds_kml(bytes: &[u8]) -> bool {
    let is_name = |part: &[u8]| part.eq_ignore_ascii_case(b".kml");
    bytes.windows(4).any(is_name)
}
