//! Reading a mission file: GeoJSON, where what we do not know is kept as it stands.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;
use serde_json::Value;
use serde_json::value::RawValue;

use super::globe;
use super::text::{Members, Text};
use super::{FEATURE_MEMBER, MapReference, Mission, MissionError, OTHER_FEATURES, VERSION};
use crate::flight::{CameraFile, OriginFile};
use crate::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame};
use crate::landmark::Landmark;
use crate::navigator::NavigatorSettings;

#[derive(Deserialize)]
struct Polygon {
    coordinates: Vec<Vec<Vec<f64>>>,
}

/// A feature that is a landmark, before the world frame is known.
struct Found {
    /// Longitude and latitude of the corners, degrees.
    corners: Vec<(f64, f64)>,
    reference: Option<(f64, f64)>,
    id: Option<u32>,
    name: Option<String>,
    height: f64,
    enabled: bool,
    properties: BTreeMap<String, String>,
}

/// Reads a mission file.
///
/// Every polygon feature is a landmark, whoever wrote it; other features, unknown properties and
/// unknown members are kept as JSON text. Without an origin the middle of all polygons is taken.
pub fn read_mission(bytes: &[u8]) -> Result<Mission, MissionError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let content = std::str::from_utf8(bytes).map_err(|e| MissionError::NotText(e.valid_up_to()))?;
    let text = Text(content);
    let mut members = text.members(content)?;
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
    let mut found = Vec::new();
    let mut others: Vec<&RawValue> = Vec::new();
    for feature in text.elements(features.get())? {
        match landmark(&text, feature)? {
            Some(landmark) => found.push(landmark),
            None => others.push(feature),
        }
    }
    let origin = origin(&text, &mut members, &found)?;
    let camera_place = members.get("camera").map(|piece| piece.get());
    let camera: Option<CameraFile> = text.take(&mut members, "camera")?;
    let camera = camera
        .map(|camera| camera.camera())
        .transpose()
        .map_err(|cause| text.error(camera_place.unwrap_or(content), format!("camera: {cause}")))?;
    let mut mission = Mission {
        name: text
            .take(&mut members, "name")?
            .unwrap_or_else(|| "Mission".to_owned()),
        origin,
        map: map(&text, &mut members)?,
        landmarks: landmarks(found, &LocalFrame::new(origin)),
        routes: Vec::new(),
        camera,
        navigator: navigator(&text, &mut members)?,
        properties: kept(members),
    };
    if !others.is_empty() {
        let list: Vec<&str> = others.iter().map(|f| f.get()).collect();
        let list = format!("[{}]", list.join(","));
        mission.properties.insert(OTHER_FEATURES.to_owned(), list);
    }
    Ok(mission)
}

fn kept(members: Members) -> BTreeMap<String, String> {
    members
        .into_iter()
        .map(|(name, value)| (name, value.get().to_owned()))
        .collect()
}

/// The landmark that a feature is; `None` for anything but a polygon.
fn landmark<'a>(text: &Text<'a>, feature: &'a RawValue) -> Result<Option<Found>, MissionError> {
    let mut members = text.members(feature.get())?;
    let Some(geometry) = members.get("geometry").copied() else {
        return Ok(None);
    };
    let kind: Value = text.value(geometry.get())?;
    if kind.get("type").and_then(Value::as_str) != Some("Polygon") {
        return Ok(None);
    }
    let polygon: Polygon = text.value(geometry.get())?;
    let corner = |position: &Vec<f64>| match position[..] {
        [longitude, latitude, ..] if on_globe(longitude, latitude) => Ok((longitude, latitude)),
        _ => Err(text.error(
            geometry.get(),
            "a corner needs a longitude and a latitude in degrees",
        )),
    };
    let corners: Vec<(f64, f64)> = polygon
        .coordinates
        .iter()
        .take(1)
        .flatten()
        .map(corner)
        .collect::<Result<_, _>>()?;
    if corners.len() < 3 {
        return Err(text.error(geometry.get(), "a polygon has at least three corners"));
    }
    members.remove("geometry");
    members.remove("type");
    let mut properties = match members.remove("properties") {
        Some(piece) if piece.get() != "null" => text.members(piece.get())?,
        _ => Members::new(),
    };
    let reference_place = properties.get("reference").map(|piece| piece.get());
    let reference: Option<(f64, f64)> = text.take(&mut properties, "reference")?;
    if let Some((longitude, latitude)) = reference
        && !on_globe(longitude, latitude)
    {
        return Err(text.error(
            reference_place.unwrap_or(feature.get()),
            "the reference is not a longitude and a latitude in degrees",
        ));
    }
    let mut found = Found {
        corners,
        reference,
        id: text.take(&mut properties, "id")?,
        name: text.take(&mut properties, "name")?,
        height: text.take(&mut properties, "height_m")?.unwrap_or(0.0),
        enabled: text.take(&mut properties, "enabled")?.unwrap_or(true),
        properties: kept(properties),
    };
    for (name, value) in kept(members) {
        found
            .properties
            .insert(format!("{FEATURE_MEMBER}{name}"), value);
    }
    Ok(Some(found))
}

fn on_globe(longitude: f64, latitude: f64) -> bool {
    (-540.0..=540.0).contains(&longitude) && (-90.0..=90.0).contains(&latitude)
}

fn origin<'a>(
    text: &Text<'a>,
    members: &mut Members<'a>,
    found: &[Found],
) -> Result<Geodetic, MissionError> {
    let place = members.get("origin").map(|piece| piece.get());
    if let Some(origin) = text.take::<OriginFile>(members, "origin")? {
        return origin
            .geodetic()
            .map_err(|cause| text.error(place.unwrap_or(text.0), format!("origin: {cause}")));
    }
    let corners: Vec<(f64, f64)> = found.iter().flat_map(|f| f.corners.clone()).collect();
    let count = corners.len().max(1) as f64;
    let longitude = corners.iter().map(|c| c.0).sum::<f64>() / count;
    let latitude = corners.iter().map(|c| c.1).sum::<f64>() / count;
    Ok(Geodetic::from_degrees(latitude, longitude, 0.0))
}

fn map<'a>(
    text: &Text<'a>,
    members: &mut Members<'a>,
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
    members: &mut Members<'a>,
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

/// Landmarks with identities: those of the file, and free ones where it has none or has one twice.
fn landmarks(found: Vec<Found>, frame: &LocalFrame) -> Vec<Landmark> {
    let mut taken = BTreeSet::new();
    let own: Vec<bool> = found
        .iter()
        .map(|f| f.id.is_some_and(|id| taken.insert(id)))
        .collect();
    let mut next = 1;
    let mut free = || {
        while !taken.insert(next) {
            next += 1;
        }
        next
    };
    found
        .into_iter()
        .zip(own)
        .map(|(found, own)| {
            let id = found.id.filter(|_| own).unwrap_or_else(&mut free);
            let point =
                |(longitude, latitude): (f64, f64)| globe::ground(frame, longitude, latitude);
            let corners: Vec<GroundPoint> = found.corners.iter().copied().map(point).collect();
            let bounds = globe::bounds(&corners)
                .unwrap_or_else(|| GroundRect::centered(GroundPoint::default(), 0.0, 0.0));
            Landmark {
                name: found.name.unwrap_or_else(|| format!("Landmark {id}")),
                height: found.height,
                enabled: found.enabled,
                reference: found.reference.map_or(bounds.center(), point),
                properties: found.properties,
                ..Landmark::new(id, "", bounds)
            }
        })
        .collect()
}
