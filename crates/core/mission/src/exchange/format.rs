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
