//! Roads out of files: OpenStreetMap's XML and PBF, and lines of GeoJSON.

mod error;
mod geo_json;
mod globe_road;
mod open_street_map;
mod osm_pbf;
mod osm_xml;
mod property;
mod protobuf;
mod write;

pub use error::RoadFileError;
pub use globe_road::{GlobeRoad, RoadsRead};
pub use property::{HIGHWAY, WIDTH};
pub use write::write_roads;

/// Whether a line of GeoJSON says by [`HIGHWAY`] that it is a road; also of what cannot be read, of which
/// [`read_roads`] says why.
///
/// ```
/// use pilotage_roads::files::names_roads;
///
/// let stop = r#"{"features": [{"properties": {"highway": "bus_stop"},
///     "geometry": {"type": "Point", "coordinates": [8.0, 47.0]}}]}"#;
/// assert!(!names_roads(stop.as_bytes()));
/// ```
pub fn names_roads(bytes: &[u8]) -> bool {
    geo_json::names_roads(without_byte_order(bytes))
}

/// Reads the roads of a file, whose kind its first bytes tell.
///
/// ```
/// use pilotage_roads::files::read_roads;
///
/// let xml = r#"<osm version="0.6">
///     <node id="1" lat="47.0" lon="8.0"/><node id="2" lat="47.2" lon="8.4"/>
///     <way id="7"><nd ref="1"/><nd ref="2"/><nd ref="3"/><tag k="highway" v="track"/><tag k="lanes" v="2"/></way>
/// </osm>"#;
/// let read = read_roads(xml.as_bytes())?;
/// assert_eq!(read.roads[0].course, [(8.0, 47.0), (8.4, 47.2)]);
/// assert_eq!(read.roads[0].width, 6.5); // two lanes of 3.25 m
/// assert_eq!(read.missing_points, 1);
/// # Ok::<(), pilotage_roads::files::RoadFileError>(())
/// ```
///
/// # Errors
/// The file is of another kind, or broken.
pub fn read_roads(bytes: &[u8]) -> Result<RoadsRead, RoadFileError> {
    let text = without_byte_order(bytes);
    match text.iter().find(|byte| !byte.is_ascii_whitespace()) {
        Some(b'{') => geo_json::read(text),
        Some(b'<') => osm_xml::read(text),
        _ if osm_pbf::is_pbf(bytes) => osm_pbf::read(bytes),
        _ => Err(RoadFileError::Unknown),
    }
}

fn without_byte_order(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

#[cfg(test)]
mod tests;
