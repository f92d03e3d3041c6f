//! The formats.

use serde::{Deserialize, Serialize};

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

    /// All formats, in the order in which people are offered them.
    pub const WRITTEN: [Self; 9] = [
        Self::Plan,
        Self::Waypoints,
        Self::Kml,
        Self::Kmz,
        Self::Wpml,
        Self::Litchi,
        Self::Gpx,
        Self::GeoJson,
        Self::Csv,
    ];

    /// Words for a file of the format, as in "save the route as …".
    pub fn as_words(self) -> &'static str {
        match self {
            Self::Plan => "a QGroundControl plan",
            Self::Waypoints => "way-points (QGC WPL)",
            Self::Wpml => "a mission of DJI (WPML)",
            Self::Litchi => "a table of Litchi",
            Self::Kml | Self::Kmz | Self::GeoJson | Self::Gpx | Self::Csv => self.name(),
        }
    }

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

    /// Whether it holds a flown track.
    pub fn holds_tracks(self) -> bool {
        !self.is_mission()
    }

    /// Whether it holds one mission of an aircraft, and nothing else.
    fn is_mission(self) -> bool {
        use Format::{Litchi, Plan, Waypoints, Wpml};
        matches!(self, Plan | Waypoints | Wpml | Litchi)
    }

    /// The format that the extension of a file's name says.
    ///
    /// ```
    /// use pilotage_mission::exchange::Format;
    ///
    /// assert_eq!(Format::of_name("flights/Out.GPX"), Some(Format::Gpx));
    /// assert_eq!(Format::of_name("letter.pdf"), None);
    /// ```
    pub fn of_name(name: &str) -> Option<Self> {
        let (_, extension) = name.rsplit_once('.')?;
        Self::ALL.into_iter().find(|format| {
            format
                .extensions()
                .iter()
                .any(|own| own.eq_ignore_ascii_case(extension))
        })
    }
}
