//! Lines of GeoJSON: roads where they say so by `highway`, or all of them where none does.

use pilotage_base::loose_json::without_not_a_number;
use serde_json::Value;

use super::error::RoadFileError;
use super::globe_road::{GlobeRoad, RoadsRead};
use super::property::{HIGHWAY, WIDTH};
use crate::line::RoadClass;

/// Whether a line says that it is a road.
pub fn names_roads(bytes: &[u8]) -> bool {
    let Ok(file) = value(bytes) else {
        return true;
    };
    let features = file["features"].as_array().map_or(&[][..], Vec::as_slice);
    features
        .iter()
        .any(|feature| says_highway(feature) && !lines(feature).is_empty())
}

/// The value of a file, in which numbers may be none (`NaN`).
fn value(bytes: &[u8]) -> serde_json::Result<Value> {
    let numbers = std::str::from_utf8(bytes)
        .ok()
        .and_then(without_not_a_number);
    match &numbers {
        Some((json, _)) => serde_json::from_str(json),
        None => serde_json::from_slice(bytes),
    }
}

fn says_highway(feature: &Value) -> bool {
    feature["properties"][HIGHWAY].is_string()
}

/// Coordinates of the lines of a feature.
fn lines(feature: &Value) -> Vec<&Value> {
    let geometry = &feature["geometry"];
    match geometry["type"].as_str() {
        Some("LineString") => vec![&geometry["coordinates"]],
        Some("MultiLineString") => {
            let lines = geometry["coordinates"].as_array();
            lines.map_or_else(Vec::new, |lines| lines.iter().collect())
        }
        _ => Vec::new(),
    }
}

/// Reads the roads of a file.
pub fn read(bytes: &[u8]) -> Result<RoadsRead, RoadFileError> {
    let file = value(bytes).map_err(|error| {
        let lines = bytes.split(|byte| *byte == b'\n').take(error.line() - 1);
        let before: usize = lines.map(|line| line.len() + 1).sum();
        RoadFileError::broken(before + error.column().saturating_sub(1), error)
    })?;
    let no_features = || RoadFileError::Unread("no features of GeoJSON".to_owned());
    let features = file["features"].as_array().ok_or_else(no_features)?;
    let says_so = features.iter().any(says_highway);
    let mut read = RoadsRead::default();
    for feature in features {
        let properties = &feature["properties"];
        // A mission has routes as well.
        let is_other = properties["pilotage"]
            .as_str()
            .is_some_and(|mark| mark != "road");
        let class = match properties[HIGHWAY].as_str() {
            _ if is_other => None,
            Some(highway) => RoadClass::of_highway(highway),
            None => (!says_so).then(RoadClass::default),
        };
        let lines = lines(feature);
        let (Some(class), false) = (class, lines.is_empty()) else {
            read.others += 1;
            continue;
        };
        let text = |key: &str| match &properties[key] {
            Value::String(text) => Some(text.clone()),
            Value::Number(number) => Some(number.to_string()),
            _ => None,
        };
        let width = text(WIDTH).or_else(|| text("width"));
        for line in lines {
            let points = line.as_array().map_or(&[][..], Vec::as_slice);
            let place = |point: &Value| {
                let (lon, lat) = (point[0].as_f64()?, point[1].as_f64()?);
                let is_on_globe = lon.abs() <= 540.0 && lat.abs() <= 90.0;
                is_on_globe.then_some((lon, lat))
            };
            // A line is cut where a point cannot be read: no straight piece is made up across it.
            let places: Vec<Option<(f64, f64)>> = points.iter().map(place).collect();
            read.missing_points += places.iter().filter(|place| place.is_none()).count();
            for run in places.split(Option::is_none).filter(|run| run.len() > 1) {
                let course = run.iter().copied().flatten().collect();
                let name = text("name").unwrap_or_default();
                let lanes = text("lanes");
                let road = GlobeRoad::new(class, &name, width.as_deref(), lanes.as_deref(), course);
                read.roads.push(road);
            }
        }
    }
    Ok(read)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_cut_where_a_point_cannot_be_read() {
        let file = r#"{"features": [{"geometry": {"type": "LineString",
            "coordinates": [[8.0, 47.0], [8.01, null], [8.0, 47.1], [8.0, 47.11]]}}]}"#;
        let read = read(file.as_bytes()).unwrap();
        let courses: Vec<_> = read.roads.iter().map(|road| road.course.clone()).collect();
        assert_eq!(courses, [[(8.0, 47.1), (8.0, 47.11)]]);
        assert_eq!(read.missing_points, 1);
    }
}
