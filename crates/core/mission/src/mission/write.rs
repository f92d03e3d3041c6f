//! Writing a mission file.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde_json::{Value, json};

use super::globe;
use super::way_point_file::{altitude_members, write_way_point};
use super::{
    CAMERA_TO_LOG, FEATURE_MEMBER, LABELS, MapReference, Mission, NO_FLY_MARK, NoFlyZone,
    OTHER_FEATURES, RALLY_MARK, RETURNS, ROAD_MARK, ROUTE_MARK, RallyPoint, Route, VERSION,
};
use pilotage_base::frames::{GroundPoint, LocalFrame};
use pilotage_flight::{CameraFile, OriginFile};
use pilotage_roads::RoadLine;
use pilotage_roads::files::{HIGHWAY, WIDTH};
use pilotage_vision::landmark::Landmark;
use pilotage_vision::landmark::annotations::{HOLES, OUTLINE};

/// The mission as GeoJSON text, with everything in it that its file had and we do not know.
///
/// ```
/// use pilotage_base::frames::{Geodetic, GroundPoint, GroundRect};
/// use pilotage_mission::mission::{Mission, read_mission, write_mission};
/// use pilotage_vision::landmark::Landmark;
///
/// let mut mission = Mission::new("River", Geodetic::from_degrees(46.8, -92.0, 183.0));
/// let bounds = GroundRect::centered(GroundPoint::new(100.0, 50.0), 40.0, 20.0);
/// mission.landmarks.push(Landmark::new(1, "Bridge", bounds));
/// let text = write_mission(&mission);
/// assert!(text.contains("\"FeatureCollection\""));
/// let read = read_mission(text.as_bytes())?;
/// assert_eq!(read.landmarks[0].name, "Bridge");
/// assert!((read.landmarks[0].bounds.height() - 40.0).abs() < 0.001);
/// # Ok::<(), pilotage_mission::mission::MissionError>(())
/// ```
pub fn write_mission(mission: &Mission) -> String {
    let frame = LocalFrame::new(mission.origin);
    let mut text = String::from("{\n  \"type\": \"FeatureCollection\"");
    let mut member = |name: &str, value: &str| {
        // Writing into a string cannot fail.
        let _ = write!(text, ",\n  {}: {value}", Value::from(name));
    };
    member("pilotage_mission", VERSION);
    member("name", &Value::from(mission.name.as_str()).to_string());
    member("origin", &of(&OriginFile::of(&mission.origin)));
    match &mission.map {
        Some(MapReference::Scenario(name)) => {
            member("map", &json!({ "scenario": name }).to_string());
        }
        Some(MapReference::Picture(name)) => {
            member("map", &json!({ "picture": name }).to_string());
        }
        None => {}
    }
    if let Some(camera) = &mission.camera {
        member("camera", &of(&CameraFile::of(camera)));
    }
    if let Some(change) = &mission.camera_to_log {
        member(CAMERA_TO_LOG, &of(change));
    }
    member("navigator", &of(&mission.navigator));
    if !mission.labels.is_empty() {
        member(LABELS, &of(&mission.labels));
    }
    for (name, value) in &mission.properties {
        if name != OTHER_FEATURES {
            member(name, value);
        }
    }
    let mut features = write_features(&mission.routes, &mission.landmarks, &frame);
    features.extend(mission.no_fly.iter().map(|z| no_fly_feature(z, &frame)));
    features.extend(mission.rally.iter().map(|r| rally_feature(r, &frame)));
    features.extend(mission.roads.iter().map(|r| road_feature(r, &frame)));
    if let Some(others) = mission.properties.get(OTHER_FEATURES) {
        let inside = others
            .trim()
            .trim_start_matches('[')
            .strip_suffix(']')
            .unwrap_or("");
        if !inside.trim().is_empty() {
            features.push(inside.to_owned());
        }
    }
    member(
        "features",
        &format!("[\n    {}\n  ]", features.join(",\n    ")),
    );
    text.push_str("\n}\n");
    text
}

/// Landmarks and routes as features of GeoJSON.
pub(crate) fn write_features(
    routes: &[Route],
    landmarks: &[Landmark],
    frame: &LocalFrame,
) -> Vec<String> {
    let landmarks = landmarks.iter().map(|l| landmark_feature(l, frame));
    let routes = routes.iter().map(|r| route_feature(r, frame));
    landmarks.chain(routes).collect()
}

fn of(value: &impl serde::Serialize) -> String {
    // Plain structures of numbers and names; a number that is not finite is written as null.
    serde_json::to_string(value).unwrap_or_else(|_| "null".to_owned())
}

/// Degrees to ten decimals, a hundredth of a millimetre, so that a saved file reads and saves to
/// the same text.
pub(crate) fn degrees(value: f64) -> String {
    let text = format!("{value:.10}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn position(frame: &LocalFrame, p: &GroundPoint) -> String {
    let (longitude, latitude) = globe::lon_lat(frame, p);
    format!("[{}, {}]", degrees(longitude), degrees(latitude))
}

/// The beginning of a feature, with its members that we do not know.
fn begin(properties: &BTreeMap<String, String>) -> String {
    let mut text = String::from("{ \"type\": \"Feature\"");
    for (name, value) in properties {
        if let Some(name) = name.strip_prefix(FEATURE_MEMBER) {
            let _ = write!(text, ", {}: {value}", Value::from(name));
        }
    }
    text
}

/// The properties that we do not know, and the end of the feature.
fn end(mut text: String, properties: &BTreeMap<String, String>) -> String {
    for (name, value) in properties {
        // Outline and holes stand in the geometry.
        if !name.starts_with(FEATURE_MEMBER) && ![OUTLINE, HOLES].contains(&name.as_str()) {
            let _ = write!(text, ", {}: {value}", Value::from(name.as_str()));
        }
    }
    text.push_str(" } }");
    text
}

fn landmark_feature(landmark: &Landmark, frame: &LocalFrame) -> String {
    let rings: Vec<String> = rings(landmark)
        .iter()
        .map(|ring| self::ring(frame, ring))
        .collect();
    let mut text = begin(&landmark.properties);
    let _ = write!(
        text,
        ",\n      \"geometry\": {{ \"type\": \"Polygon\", \"coordinates\": [{}] }},\n      \
         \"properties\": {{ \"id\": {}, \"name\": {}, \"reference\": {}, \"height_m\": {}, \
         \"enabled\": {}",
        rings.join(", "),
        landmark.id,
        Value::from(landmark.name.as_str()),
        position(frame, &landmark.reference),
        Value::from(landmark.height),
        landmark.enabled,
    );
    end(text, &landmark.properties)
}

/// Rings of a landmark, each with its first corner again at the end: its outline or its box, then its
/// holes.
pub(crate) fn rings(landmark: &Landmark) -> Vec<Vec<GroundPoint>> {
    let closed = |mut corners: Vec<GroundPoint>| {
        corners.extend(corners.first().copied());
        corners
    };
    let outer = landmark
        .outline()
        .map_or_else(|| globe::ring(&landmark.bounds).to_vec(), closed);
    let holes = landmark.holes().into_iter().map(closed);
    std::iter::once(outer).chain(holes).collect()
}

/// A ring as GeoJSON has it.
fn ring(frame: &LocalFrame, corners: &[GroundPoint]) -> String {
    let corners: Vec<String> = corners.iter().map(|p| position(frame, p)).collect();
    format!("[{}]", corners.join(", "))
}

/// An area that must not be flown over as a feature of GeoJSON.
pub(crate) fn no_fly_feature(zone: &NoFlyZone, frame: &LocalFrame) -> String {
    let rings: Vec<String> = std::iter::once(&zone.corners)
        .chain(&zone.holes)
        .map(|corners| {
            let around: Vec<GroundPoint> = corners.iter().chain(corners.first()).copied().collect();
            ring(frame, &around)
        })
        .collect();
    let mut text = begin(&zone.properties);
    let (mark, marked) = NO_FLY_MARK;
    let _ = write!(
        text,
        ",\n      \"geometry\": {{ \"type\": \"Polygon\", \"coordinates\": [{}] }},\n      \
         \"properties\": {{ \"{mark}\": {marked}, \"name\": {}",
        rings.join(", "),
        Value::from(zone.name.as_str()),
    );
    end(text, &zone.properties)
}

/// A rally point as a feature of GeoJSON.
pub(crate) fn rally_feature(point: &RallyPoint, frame: &LocalFrame) -> String {
    let mut text = begin(&point.properties);
    let (mark, marked) = RALLY_MARK;
    let _ = write!(
        text,
        ",\n      \"geometry\": {{ \"type\": \"Point\", \"coordinates\": {} }},\n      \
         \"properties\": {{ \"{mark}\": {marked}, \"name\": {}, {}",
        position(frame, &point.position),
        Value::from(point.name.as_str()),
        altitude_members(&point.altitude),
    );
    end(text, &point.properties)
}

/// A road as a feature of GeoJSON.
fn road_feature(road: &RoadLine, frame: &LocalFrame) -> String {
    let course: Vec<String> = road.course.iter().map(|p| position(frame, p)).collect();
    let mut text = begin(&road.properties);
    let (mark, marked) = ROAD_MARK;
    let _ = write!(
        text,
        ",\n      \"geometry\": {{ \"type\": \"LineString\", \"coordinates\": [{}] }},\n      \
         \"properties\": {{ \"{mark}\": {marked}, \"name\": {}, \"{HIGHWAY}\": \"{}\", \"{WIDTH}\": {}",
        course.join(", "),
        Value::from(road.name.as_str()),
        road.class.key(),
        Value::from(road.width),
    );
    end(text, &road.properties)
}

fn route_feature(route: &Route, frame: &LocalFrame) -> String {
    let positions: Vec<String> = route
        .way_points
        .iter()
        .map(|w| position(frame, &w.position))
        .collect();
    let geometry = match &positions[..] {
        [] => "null".to_owned(),
        // A line has two points at least.
        [only] => format!("{{ \"type\": \"Point\", \"coordinates\": {only} }}"),
        all => format!(
            "{{ \"type\": \"LineString\", \"coordinates\": [{}] }}",
            all.join(", ")
        ),
    };
    let way_points: Vec<String> = route.way_points.iter().map(write_way_point).collect();
    let way_points = if way_points.is_empty() {
        "[]".to_owned()
    } else {
        format!("[\n        {}\n      ]", way_points.join(",\n        "))
    };
    let mut text = begin(&route.properties);
    let (mark, marked) = ROUTE_MARK;
    let _ = write!(
        text,
        ",\n      \"geometry\": {geometry},\n      \"properties\": {{ \"{mark}\": {marked}, \
         \"id\": {}, \"name\": {}, \"way_points\": {way_points}",
        route.id,
        Value::from(route.name.as_str()),
    );
    if route.returns {
        let _ = write!(text, ", \"{RETURNS}\": true");
    }
    end(text, &route.properties)
}
