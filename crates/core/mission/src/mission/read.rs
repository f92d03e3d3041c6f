//! Reading a mission file: GeoJSON, where what we do not know is kept as it stands.

use serde::Deserialize;
use serde_json::Value;
use serde_json::value::RawValue;

use super::found::{self, FoundLandmark, FoundNoFly, FoundRally, ReadRoute};
use super::read_feature::{GeoJsonFeature, feature};
use super::road::FoundRoad;
use super::text::{ObjectMembers, Text};
use super::way_point_file::kept;
use super::{CAMERA_TO_LOG, LABELS, MapReference, Mission, MissionError, OTHER_FEATURES, VERSION};
use crate::settings::{CameraAdjustment, NavigatorSettings};
use pilotage_base::frames::{Geodetic, LocalFrame};
use pilotage_flight::{CameraFile, OriginFile};

/// Reads a mission file.
///
/// Every polygon feature is a landmark, whoever wrote it, unless it is marked as a no-fly area, and
/// every feature marked as one a route, a rally point or a road; other features, unknown properties and unknown members are kept as JSON text. Without an origin
/// the middle of all polygons and routes is taken.
pub fn read_mission(bytes: &[u8]) -> Result<Mission, MissionError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let content = std::str::from_utf8(bytes).map_err(|e| MissionError::NotText(e.valid_up_to()))?;
    let text = Text(content);
    let (found, mut members) = read_features(&text)?;
    let origin = found
        .origin
        .or_else(|| found::middle(&found.landmarks, &found.routes))
        .unwrap_or(Geodetic::from_degrees(0.0, 0.0, 0.0));
    let frame = LocalFrame::new(origin);
    let camera_place = members.get("camera").map(|piece| piece.get());
    let camera: Option<CameraFile> = text.take(&mut members, "camera")?;
    let camera = camera
        .map(|camera| camera.camera())
        .transpose()
        .map_err(|cause| text.error(camera_place.unwrap_or(content), format!("camera: {cause}")))?;
    let change_place = members.get(CAMERA_TO_LOG).map(|piece| piece.get());
    let camera_to_log: Option<CameraAdjustment> = text.take(&mut members, CAMERA_TO_LOG)?;
    if camera_to_log.is_some_and(|change| !change.is_sound()) {
        let place = change_place.unwrap_or(content);
        let words = "camera_to_log: no camera is that far beside its log";
        return Err(text.error(place, words.to_owned()));
    }
    let mut mission = Mission {
        name: text
            .take(&mut members, "name")?
            .unwrap_or_else(|| "Mission".to_owned()),
        origin,
        map: map(&text, &mut members)?,
        landmarks: found::landmarks(found.landmarks, &frame),
        routes: found::routes(found.routes, &frame),
        no_fly: found::no_fly(found.no_fly, &frame),
        rally: found::rally(found.rally, &frame),
        roads: found
            .roads
            .into_iter()
            .map(|road| road.in_world(&frame))
            .collect(),
        labels: text.take(&mut members, LABELS)?.unwrap_or_default(),
        camera,
        camera_to_log,
        navigator: navigator(&text, &mut members)?,
        properties: kept(members),
    };
    if !found.others.is_empty() {
        let list: Vec<&str> = found.others.iter().map(|f| f.get()).collect();
        let list = format!("[{}]", list.join(","));
        mission.properties.insert(OTHER_FEATURES.to_owned(), list);
    }
    Ok(mission)
}

/// Features of a collection by kind, still on the globe.
pub(crate) struct FoundFeatures<'a> {
    /// Landmarks in the order of the file.
    pub landmarks: Vec<FoundLandmark>,
    /// Routes in the order of the file.
    pub routes: Vec<ReadRoute>,
    /// Areas that must not be flown over.
    pub no_fly: Vec<FoundNoFly>,
    /// Rally points.
    pub rally: Vec<FoundRally>,
    /// Roads.
    pub roads: Vec<FoundRoad>,
    /// Somebody else's features.
    pub others: Vec<&'a RawValue>,
    /// Origin that the file states.
    pub origin: Option<Geodetic>,
}

/// Reads the features of a collection and its origin; the second is what other members there are.
pub(crate) fn read_features<'a>(
    text: &Text<'a>,
) -> Result<(FoundFeatures<'a>, ObjectMembers<'a>), MissionError> {
    let mut members = text.members(text.0)?;
    let kind: Option<Value> = text.take(&mut members, "type")?;
    let features = members.remove("features");
    let (Some("FeatureCollection"), Some(features)) =
        (kind.as_ref().and_then(Value::as_str), features)
    else {
        return Err(MissionError::NotAFeatureCollection);
    };
    if let Some(version) = members.remove("pilotage_mission")
        && version.get() != VERSION
    {
        return Err(MissionError::Version {
            line: text.line(version.get()),
            version: version.get().chars().take(20).collect(),
        });
    }
    let (mut landmarks, mut routes) = (Vec::new(), Vec::new());
    let (mut no_fly, mut rally, mut others) = (Vec::new(), Vec::new(), Vec::new());
    let mut roads = Vec::new();
    for piece in text.elements(features.get())? {
        match feature(text, piece)? {
            GeoJsonFeature::Landmark(landmark) => landmarks.push(landmark),
            GeoJsonFeature::Route(route) => routes.push(route),
            GeoJsonFeature::NoFly(zone) => no_fly.push(zone),
            GeoJsonFeature::Rally(point) => rally.push(point),
            GeoJsonFeature::Road(road) => roads.push(road),
            GeoJsonFeature::Other => others.push(piece),
        }
    }
    let place = members.get("origin").map(|piece| piece.get());
    let origin = text.take::<OriginFile>(&mut members, "origin")?;
    let origin = origin
        .map(|origin| origin.geodetic())
        .transpose()
        .map_err(|cause| text.error(place.unwrap_or(text.0), format!("origin: {cause}")))?;
    let found = FoundFeatures {
        landmarks,
        routes,
        no_fly,
        rally,
        roads,
        others,
        origin,
    };
    Ok((found, members))
}

fn map<'a>(
    text: &Text<'a>,
    members: &mut ObjectMembers<'a>,
) -> Result<Option<MapReference>, MissionError> {
    #[derive(Deserialize)]
    #[serde(rename_all = "snake_case")]
    enum MapFile {
        Scenario(String),
        Picture(String),
    }
    let map: Option<MapFile> = text.take(members, "map")?;
    Ok(map.map(|map| match map {
        MapFile::Scenario(name) => MapReference::Scenario(name),
        MapFile::Picture(name) => MapReference::Picture(name),
    }))
}

/// The settings of the file laid over the usual ones, so that a file may state a few only.
fn navigator<'a>(
    text: &Text<'a>,
    members: &mut ObjectMembers<'a>,
) -> Result<NavigatorSettings, MissionError> {
    let usual = NavigatorSettings::default();
    let Some(piece) = members.remove("navigator") else {
        return Ok(usual);
    };
    let stated: Value = text.value(piece.get())?;
    let laid_over = serde_json::to_value(&usual).map(|mut all| {
        lay_over(&mut all, stated);
        all
    });
    laid_over
        .and_then(serde_json::from_value)
        .map_err(|e| text.error(piece.get(), format!("navigator: {e}")))
}

fn lay_over(all: &mut Value, stated: Value) {
    match (all, stated) {
        (Value::Object(all), Value::Object(stated)) => {
            for (name, value) in stated {
                match all.get_mut(&name) {
                    Some(place) => lay_over(place, value),
                    None => {
                        all.insert(name, value);
                    }
                }
            }
        }
        (place, value) => *place = value,
    }
}
