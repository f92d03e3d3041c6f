//! GeoJSON: our own features, and anybody else's points, lines and polygons.

use std::collections::BTreeMap;

use serde_json::Value;

use super::ExchangeError;
use super::found::{Found, POINT_BOX};
use crate::mission::found::{Extent, FoundLandmark, FoundRoute, LonLat, on_globe};
use crate::mission::text::Text;
use crate::mission::{
    FEATURE_MEMBER, Route, USUAL_ALTITUDE, WayPoint, read_features, write_features,
};
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint, LocalFrame};
use pilotage_vision::landmark::Landmark;

/// Reads a collection, a single feature or a bare geometry.
pub(super) fn read(file: &str, content: &str) -> Result<Found, ExchangeError> {
    // A piece is put into a collection on its own first line, so that lines stay what they are.
    let kind = serde_json::from_str::<Value>(content)
        .ok()
        .and_then(|value| value.get("type")?.as_str().map(str::to_owned));
    let feature = |geometry: &str| {
        format!("{{\"type\":\"Feature\",\"properties\":{{}},\"geometry\":{geometry}}}")
    };
    let collection =
        |feature: &str| format!("{{\"type\":\"FeatureCollection\",\"features\":[{feature}]}}");
    let content = match kind.as_deref() {
        Some("Feature") => collection(content),
        Some(kind) if kind != "FeatureCollection" => collection(&feature(content)),
        _ => content.to_owned(),
    };
    let text = Text(&content);
    let (features, _) = read_features(&text).map_err(|e| ExchangeError::of_json(file, e))?;
    let mut found = Found {
        routes: features.routes,
        landmarks: features.landmarks,
        no_fly: features.no_fly,
        notes: Vec::new(),
        origin: features.origin,
    };
    let mut other = Others::default();
    for piece in &features.others {
        let error = |cause: String| ExchangeError::of_json(file, text.error(piece.get(), cause));
        let feature: Value = serde_json::from_str(piece.get()).map_err(|e| error(e.to_string()))?;
        let geometry = feature.get("geometry").unwrap_or(&Value::Null);
        other
            .geometry(geometry, &feature, &mut found)
            .map_err(error)?;
    }
    if other.heights > 0 {
        found.notes.push(
            "heights in the coordinates are taken for altitudes above mean sea level".to_owned(),
        );
    }
    if other.plain_lines > 0 {
        found.notes.push(format!(
            "{} of the lines state no altitude: {USUAL_ALTITUDE} is taken",
            other.plain_lines
        ));
    }
    if other.points > 0 {
        found.notes.push(format!(
            "{} of the places are points: each gets a box of {POINT_BOX} m",
            other.points
        ));
    }
    if other.skipped > 0 {
        found.notes.push(format!(
            "{} features are neither point, line nor polygon, and are left out",
            other.skipped
        ));
    }
    Ok(found)
}

/// What was met in features that are not ours.
#[derive(Default)]
struct Others {
    points: usize,
    heights: usize,
    plain_lines: usize,
    skipped: usize,
}

impl Others {
    fn geometry(
        &mut self,
        geometry: &Value,
        feature: &Value,
        found: &mut Found,
    ) -> Result<(), String> {
        let kind = geometry.get("type").and_then(Value::as_str).unwrap_or("");
        let coordinates = geometry.get("coordinates").unwrap_or(&Value::Null);
        let each =
            |value: &'_ Value| -> Vec<Value> { value.as_array().cloned().unwrap_or_default() };
        match kind {
            "Point" => self.point(coordinates, feature, found)?,
            "MultiPoint" => {
                for point in each(coordinates) {
                    self.point(&point, feature, found)?;
                }
            }
            "LineString" => self.line(coordinates, feature, found)?,
            "MultiLineString" => {
                for line in each(coordinates) {
                    self.line(&line, feature, found)?;
                }
            }
            "MultiPolygon" => {
                for polygon in each(coordinates) {
                    let ring = polygon.get(0).cloned().unwrap_or_default();
                    let corners: Vec<LonLat> = each(&ring)
                        .iter()
                        .map(|p| Ok(position(p)?.0))
                        .collect::<Result<_, String>>()?;
                    if corners.len() < 3 {
                        return Err("a polygon has at least three corners".to_owned());
                    }
                    found.landmarks.push(FoundLandmark {
                        name: name(feature),
                        properties: properties(feature),
                        ..FoundLandmark::new(Extent::Corners(corners))
                    });
                }
            }
            "GeometryCollection" => {
                for geometry in each(geometry.get("geometries").unwrap_or(&Value::Null)) {
                    self.geometry(&geometry, feature, found)?;
                }
            }
            _ => self.skipped += 1,
        }
        Ok(())
    }

    fn point(
        &mut self,
        coordinates: &Value,
        feature: &Value,
        found: &mut Found,
    ) -> Result<(), String> {
        self.points += 1;
        found.landmarks.push(FoundLandmark {
            name: name(feature),
            properties: properties(feature),
            ..FoundLandmark::new(Extent::Point(position(coordinates)?.0))
        });
        Ok(())
    }

    fn line(
        &mut self,
        coordinates: &Value,
        feature: &Value,
        found: &mut Found,
    ) -> Result<(), String> {
        let positions = coordinates
            .as_array()
            .ok_or("a line needs a list of positions")?;
        let mut way_points = Vec::with_capacity(positions.len());
        let mut has_heights = false;
        for value in positions {
            let (place, height) = position(value)?;
            has_heights |= height.is_some();
            let altitude = height.map_or(USUAL_ALTITUDE, |m| Altitude::new(m, AltitudeFrame::Amsl));
            way_points.push((place, WayPoint::new(GroundPoint::default(), altitude)));
        }
        self.heights += usize::from(has_heights);
        self.plain_lines += usize::from(!has_heights);
        found.routes.push(FoundRoute {
            name: name(feature),
            way_points,
            properties: properties(feature),
            ..FoundRoute::default()
        });
        Ok(())
    }
}

/// Longitude and latitude of a position, and its height where it has one.
fn position(value: &Value) -> Result<(LonLat, Option<f64>), String> {
    let number = |i: usize| value.get(i).and_then(Value::as_f64);
    match (number(0), number(1)) {
        (Some(longitude), Some(latitude)) if on_globe(longitude, latitude) => {
            Ok(((longitude, latitude), number(2)))
        }
        _ => Err(format!(
            "{value} is no position: it needs a longitude and a latitude in degrees"
        )),
    }
}

fn name(feature: &Value) -> Option<String> {
    let properties = feature.get("properties")?;
    ["name", "Name", "title"]
        .iter()
        .find_map(|key| properties.get(key)?.as_str())
        .map(str::to_owned)
}

/// Everything that a feature says of itself, as JSON text.
fn properties(feature: &Value) -> BTreeMap<String, String> {
    let members = |value: Option<&Value>| value.and_then(Value::as_object).cloned();
    let own = members(feature.get("properties")).unwrap_or_default();
    let own = own
        .into_iter()
        .filter(|(name, _)| name != "name")
        .map(|(name, value)| match name.as_str() {
            // The names that we write ourselves.
            "id" | "reference" | "height_m" | "enabled" | "way_points" => {
                (format!("{name}_in_file"), value)
            }
            _ => (name, value),
        });
    let beside = members(Some(feature)).unwrap_or_default();
    let beside = beside
        .into_iter()
        .filter(|(name, _)| !["type", "geometry", "properties"].contains(&name.as_str()))
        .map(|(name, value)| (format!("{FEATURE_MEMBER}{name}"), value));
    own.chain(beside)
        .map(|(name, value)| (name, value.to_string()))
        .collect()
}

/// Routes and landmarks as a collection of features.
pub(super) fn write(
    routes: &[Route],
    landmarks: &[Landmark],
    frame: &LocalFrame,
) -> (String, Vec<String>) {
    let features = write_features(routes, landmarks, frame);
    let text = format!(
        "{{\n  \"type\": \"FeatureCollection\",\n  \"features\": [\n    {}\n  ]\n}}\n",
        features.join(",\n    ")
    );
    (text, Vec::new())
}
