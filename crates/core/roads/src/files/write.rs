//! Roads as GeoJSON.

use pilotage_base::frames::LocalFrame;
use serde_json::{Value, json};

use super::property::{HIGHWAY, WIDTH};
use crate::line::RoadLine;

/// Roads as a collection of GeoJSON's lines with `highway`, `name` and `width_m`, marked as missions mark them; degrees
/// to eight decimals, a millimetre.
pub fn write_roads(lines: &[RoadLine], frame: &LocalFrame) -> String {
    let rounded = |degrees: f64| (degrees * 1e8).round() / 1e8;
    let feature = |line: &RoadLine| -> Value {
        let places = line.course.iter().map(|p| frame.geodetic_from_ground(p));
        let course: Vec<[f64; 2]> = places
            .map(|p| [p.longitude, p.latitude].map(|angle| rounded(angle.to_degrees())))
            .collect();
        json!({
            "type": "Feature",
            "geometry": { "type": "LineString", "coordinates": course },
            "properties": {
                "pilotage": "road",
                "name": line.name,
                HIGHWAY: line.class.key(),
                WIDTH: line.width,
            },
        })
    };
    let features: Vec<String> = lines.iter().map(|line| feature(line).to_string()).collect();
    format!(
        "{{\"type\":\"FeatureCollection\",\"features\":[\n{}\n]}}\n",
        features.join(",\n")
    )
}
