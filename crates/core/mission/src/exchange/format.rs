//! The formats and how a file is told to be in one of them.

use serde::{Deserialize, Serialize};

use super::wpml;

/// A format of files with routes or landmarks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Format {
    /// `QGroundControl`'s plan, JSON.
    Plan,
    /// `QGC WPL 110`, the plain text of way-points.
    Waypoints,
    /// Keyhole markup, XML.
    Kml,
    /// Zipped KML.
    Kmz,
    /// GeoJSON, ours or others'.
    GeoJson,
    /// GPS exchange, XML.
    Gpx,
    /// Tables with a header.
    Csv,
    /// DJI's way-point mission, WPML in a KMZ.
    Wpml,
    /// Litchi's table of way-points.
    Litchi,
}

impl Format {
    /// The formats that the extension of a file's name tells, in the order in which people are offered
    /// them; those of DJI and Litchi have extensions of others.
    pub const ALL: [Self; 7] = [
        Self::Plan,
        Self::Waypoints,
        Self::Kml,
        Self::Kmz,
        Self::GeoJson,
        Self::Gpx,
        Self::Csv,
    ];

    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plan => "QGroundControl plan",
            Self::Waypoints => "QGC WPL 110",
            Self::Kml => "KML",
            Self::Kmz => "KMZ",
            Self::GeoJson => "GeoJSON",
            Self::Gpx => "GPX",
            Self::Csv => "CSV",
            Self::Wpml => "DJI WPML",
            Self::Litchi => "Litchi CSV",
        }
    }

    /// Extensions of file names, without the dot; the first is written.
    pub fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Plan => &["plan"],
            Self::Waypoints => &["waypoints", "wpl", "txt"],
            Self::Kml => &["kml"],
            Self::Kmz | Self::Wpml => &["kmz"],
            Self::GeoJson => &["geojson", "json"],
            Self::Gpx => &["gpx"],
            Self::Csv => &["csv", "tsv"],
            Self::Litchi => &["csv"],
        }
    }

    /// Whether it holds landmarks; all formats hold routes.
    pub fn holds_landmarks(self) -> bool {
        !self.is_mission()
    }

    /// Whether it holds more than one route.
    pub fn holds_several_routes(self) -> bool {
        !self.is_mission()
    }

    /// Whether it holds one mission of an aircraft, and nothing else.
    fn is_mission(self) -> bool {
        use Format::{Litchi, Plan, Waypoints, Wpml};
        matches!(self, Plan | Waypoints | Wpml | Litchi)
    }

    /// The format that the extension of a file's name says.
    pub fn of_name(name: &str) -> Option<Self> {
        let (_, extension) = name.rsplit_once('.')?;
        Self::ALL.into_iter().find(|format| {
            format
                .extensions()
                .iter()
                .any(|own| own.eq_ignore_ascii_case(extension))
        })
    }

    /// The format of a file, by its content first and its name where that leaves it open.
    pub fn of(name: &str, bytes: &[u8]) -> Option<Self> {
        if bytes.starts_with(b"PK\x03\x04") {
            return Some(if wpml::is_zip(bytes) {
                Self::Wpml
            } else {
                Self::Kmz
            });
        }
        let head = String::from_utf8_lossy(&bytes[..bytes.len().min(4096)]);
        // A sequence of GeoJSON begins with the separator of its records.
        let head = head.trim_start_matches(['\u{feff}', '\u{1e}']).trim_start();
        if head.starts_with("QGC WPL") {
            return Some(Self::Waypoints);
        }
        if head.starts_with('<') {
            return match () {
                () if wpml::is_text(head) => Some(Self::Wpml),
                () if head.contains("<gpx") => Some(Self::Gpx),
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
            return match Self::of_name(name) {
                Some(Self::Plan) => Some(Self::Plan),
                _ if is_plan => Some(Self::Plan),
                _ => Some(Self::GeoJson),
            };
        }
        let named = Self::of_name(name);
        let first_line = head.lines().next().unwrap_or("");
        let is_table = [',', ';', '\t'].iter().any(|c| first_line.contains(*c));
        match named {
            Some(Self::Waypoints) if is_table => Some(Self::Csv),
            Some(named) => Some(named),
            None => is_table.then_some(Self::Csv),
        }
    }
}
