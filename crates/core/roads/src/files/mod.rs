//! Roads out of files: OpenStreetMap's XML and PBF, and lines of GeoJSON.

mod error;
mod geo_json;
mod globe_road;
mod open_street_map;
mod osm_pbf;
mod osm_xml;
mod protobuf;
mod write;

pub use error::RoadFileError;
pub use globe_road::{GlobeRoad, RoadsRead};
pub use write::write_roads;

/// Reads the roads of a file, whose kind its first bytes tell.
///
/// # Errors
/// The file is of another kind, or broken.
pub fn read_roads(bytes: &[u8]) -> Result<RoadsRead, RoadFileError> {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match text.iter().find(|byte| !byte.is_ascii_whitespace()) {
        Some(b'{') => geo_json::read(text),
        Some(b'<') => osm_xml::read(text),
        _ if osm_pbf::is_pbf(bytes) => osm_pbf::read(bytes),
        _ => Err(RoadFileError::Unknown),
    }
}

#[cfg(test)]
mod tests;
