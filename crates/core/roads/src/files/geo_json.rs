//! Lines of GeoJSON: roads where they say so by `highway`, or all of them where none does.

use serde_json::Value;

use super::error::RoadFileError;
use super::globe_road::{GlobeRoad, RoadsRead};
use crate::line::RoadClass;

/// Reads the roads of a file.
pub fn read(bytes: &[u8]) -> Result<RoadsRead, RoadFileError> {
    let file: Value = serde_json::from_slice(bytes).map_err(|error| {
        let lines = bytes.split(|byte| *byte == b'\n').take(error.line() - 1);
        let before: usize = lines.map(|line| line.len() + 1).sum();
        RoadFileError::broken(before + error.column().saturating_sub(1), error)
    })?;
    let no_features = || RoadFileError::Unread("no features of GeoJSON".to_owned());
    let features = file["features"].as_array().ok_or_else(no_features)?;
    let says_so = features
        .iter()
        .any(|feature| feature["properties"]["highway"].is_string());
    let mut read = RoadsRead::default();
    for feature in features {
        let properties = &feature["properties"];
        // A mission has routes as well.
        let is_other = properties["pilotage"]
            .as_str()
            .is_some_and(|mark| mark != "road");
        let class = match properties["highway"].as_str() {
            _ if is_other => None,
            Some(highway) => RoadClass::of_highway(highway),
            None => (!says_so).then(RoadClass::default),
        };
        let geometry = &feature["geometry"];
        let lines: Vec<&Value> = match geometry["type"].as_str() {
            Some("LineString") => vec![&geometry["coordinates"]],
            Some("MultiLineString") => {
                let lines = geometry["coordinates"].as_array();
                lines.map_or_else(Vec::new, |lines| lines.iter().collect())
            }
            _ => Vec::new(),
        };
        let (Some(class), false) = (class, lines.is_empty()) else {
            read.others += 1;
            continue;
        };
        let text = |key: &str| match &properties[key] {
            Value::String(text) => Some(text.clone()),
            Value::Number(number) => Some(number.to_string()),
            _ => None,
        };
        let width = text("width_m").or_else(|| text("width"));
        for line in lines {
            let points = line.as_array().map_or(&[][..], Vec::as_slice);
            let place = |point: &Value| {
                let (lon, lat) = (point[0].as_f64()?, point[1].as_f64()?);
                let is_on_globe = lon.abs() <= 540.0 && lat.abs() <= 90.0;
                is_on_globe.then_some((lon, lat))
            };
            let course: Vec<(f64, f64)> = points.iter().filter_map(place).collect();
            read.missing_points += points.len() - course.len();
            if course.len() > 1 {
                let name = text("name").unwrap_or_default();
                let lanes = text("lanes");
                let road = GlobeRoad::new(class, &name, width.as_deref(), lanes.as_deref(), course);
                read.roads.push(road);
            }
        }
    }
    Ok(read)
}
