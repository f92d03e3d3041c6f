//! Features of a mission file: which are landmarks, which routes, and which somebody else's.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;
use serde_json::value::RawValue;

use super::found::{
    FoundLandmark, FoundNoFly, FoundRally, LandmarkExtent, LonLat, ReadRoute, on_globe,
};
use super::road::FoundRoad;
use super::text::{ObjectMembers, Text};
use super::way_point_file::{USUAL_ALTITUDE, kept, read_altitude, read_way_point};
use super::{
    FEATURE_MEMBER, MissionError, NO_FLY_MARK, RALLY_MARK, RETURNS, ROAD_MARK, ROUTE_MARK, WayPoint,
};
use pilotage_base::frames::GroundPoint;
use pilotage_roads::files::{HIGHWAY, WIDTH};

/// Kind of a feature, with its contents.
pub(super) enum GeoJsonFeature {
    Landmark(FoundLandmark),
    Route(ReadRoute),
    NoFly(FoundNoFly),
    Rally(FoundRally),
    Road(FoundRoad),
    Other,
}

/// Type and coordinates of a geometry, the latter as they stand.
#[derive(Deserialize)]
struct Geometry<'a> {
    r#type: String,
    #[serde(borrow)]
    coordinates: Option<&'a RawValue>,
}

/// Reads the feature `piece`: a landmark if it is a polygon, whoever wrote it; a route if it says so itself.
pub(super) fn feature<'a>(
    text: &Text<'a>,
    piece: &'a RawValue,
) -> Result<GeoJsonFeature, MissionError> {
    let mut members = text.members(piece.get())?;
    let Some(geometry) = members.get("geometry").copied() else {
        return Ok(GeoJsonFeature::Other);
    };
    let marked = |mark| match members.get("properties") {
        Some(properties) if properties.get().starts_with('{') => {
            is_marked(text, properties.get(), mark)
        }
        _ => Ok(false),
    };
    let (has_mark, is_no_fly) = (marked(ROUTE_MARK)?, marked(NO_FLY_MARK)?);
    let is_rally = marked(RALLY_MARK)?;
    let kind: Value = text.value(geometry.get())?;
    let is_polygon =
        kind.get("type").and_then(Value::as_str) == Some("Polygon") && !is_without_corners(&kind);
    let is_rally = is_rally && kind.get("type").and_then(Value::as_str) == Some("Point");
    let is_line = kind.get("type").and_then(Value::as_str) == Some("LineString");
    let is_road = is_line && marked(ROAD_MARK)?;
    if !is_polygon && !has_mark && !is_rally && !is_road {
        return Ok(GeoJsonFeature::Other);
    }
    members.remove("geometry");
    members.remove("type");
    let mut properties = match members.remove("properties") {
        Some(piece) if piece.get() != "null" => text.members(piece.get())?,
        _ => ObjectMembers::new(),
    };
    if is_rally {
        properties.remove(RALLY_MARK.0);
        let mut found = rally(text, geometry.get(), &mut properties)?;
        found.properties = with_members(properties, members);
        Ok(GeoJsonFeature::Rally(found))
    } else if is_road {
        properties.remove(ROAD_MARK.0);
        let mut found = road(text, geometry.get(), &mut properties)?;
        found.properties = with_members(properties, members);
        Ok(GeoJsonFeature::Road(found))
    } else if is_polygon && is_no_fly {
        properties.remove(NO_FLY_MARK.0);
        let (mut corners, mut holes) = rings(text, geometry.get())?;
        // A ring ends where it begins.
        for ring in std::iter::once(&mut corners).chain(&mut holes) {
            if ring.len() > 3 && ring.first() == ring.last() {
                ring.pop();
            }
        }
        Ok(GeoJsonFeature::NoFly(FoundNoFly {
            name: own(text, &mut properties, "name"),
            corners,
            holes,
            properties: with_members(properties, members),
        }))
    } else if is_polygon {
        let mut found = landmark(text, piece.get(), geometry.get(), &mut properties)?;
        found.properties = with_members(properties, members);
        add_geometry_members(&kind, &mut found.properties);
        Ok(GeoJsonFeature::Landmark(found))
    } else {
        let mut found = route(text, geometry.get(), &mut properties)?;
        found.properties = with_members(properties, members);
        Ok(GeoJsonFeature::Route(found))
    }
}

/// Whether a polygon has no ring, or fewer than three corners in its outer one.
fn is_without_corners(polygon: &Value) -> bool {
    let rings = polygon.get("coordinates").and_then(Value::as_array);
    rings.is_some_and(|rings| {
        let outer = rings.first().map(Value::as_array);
        outer.is_none_or(|ring| ring.is_some_and(|corners| corners.len() < 3))
    })
}

/// Adds what a geometry says beside its type and coordinates (the `layer` of a zone of ED-318) to properties, where none
/// is called so.
pub(crate) fn add_geometry_members(geometry: &Value, properties: &mut BTreeMap<String, String>) {
    let own = ["type", "coordinates", "geometries", "bbox", "crs"];
    for (name, value) in geometry.as_object().into_iter().flatten() {
        if !own.contains(&name.as_str()) {
            let value = || value.to_string();
            properties.entry(name.clone()).or_insert_with(value);
        }
    }
}

fn is_marked<'a>(
    text: &Text<'a>,
    properties: &'a str,
    (name, said): (&str, &str),
) -> Result<bool, MissionError> {
    let members = text.members(properties)?;
    Ok(members.get(name).is_some_and(|value| value.get() == said))
}

/// Unknown properties, and unknown members of the feature under names of their own.
fn with_members(properties: ObjectMembers, members: ObjectMembers) -> BTreeMap<String, String> {
    let mut all = kept(properties);
    for (name, value) in kept(members) {
        all.insert(format!("{FEATURE_MEMBER}{name}"), value);
    }
    all
}

fn lon_lat(text: &Text, piece: &str, position: &[f64], what: &str) -> Result<LonLat, MissionError> {
    match position {
        [longitude, latitude, ..] if on_globe(*longitude, *latitude) => Ok((*longitude, *latitude)),
        _ => Err(text.error(
            piece,
            format!("{what} needs a longitude and a latitude in degrees"),
        )),
    }
}

/// Takes a property out if it is of our type; somebody else's of the same name is kept aside.
fn own<'a, T: serde::de::DeserializeOwned>(
    text: &Text<'a>,
    properties: &mut ObjectMembers<'a>,
    name: &str,
) -> Option<T> {
    let piece = properties.remove(name)?;
    let value: Option<T> = text.value(piece.get()).ok();
    if value.is_none() && piece.get() != "null" {
        properties.insert(format!("{name}_in_file"), piece);
    }
    value
}

/// Corners of the outer ring of a polygon, and its holes.
fn rings<'a>(
    text: &Text<'a>,
    geometry: &'a str,
) -> Result<(Vec<LonLat>, Vec<Vec<LonLat>>), MissionError> {
    #[derive(Deserialize)]
    struct FeaturePolygon {
        coordinates: Vec<Vec<Vec<f64>>>,
    }
    let polygon: FeaturePolygon = text.value(geometry)?;
    // A hole without corners is none.
    let rings = polygon.coordinates.iter().enumerate();
    let rings = rings.filter(|(i, ring)| *i == 0 || ring.len() >= 3);
    let mut rings = rings.map(|(_, ring)| {
        let corners: Vec<LonLat> = ring
            .iter()
            .map(|position| lon_lat(text, geometry, position, "a corner"))
            .collect::<Result<_, _>>()?;
        if corners.len() < 3 {
            return Err(text.error(geometry, "a polygon has at least three corners"));
        }
        Ok(corners)
    });
    let outer = rings
        .next()
        .unwrap_or_else(|| Err(text.error(geometry, "a polygon has at least three corners")))?;
    Ok((outer, rings.collect::<Result<_, _>>()?))
}

fn landmark<'a>(
    text: &Text<'a>,
    feature: &'a str,
    geometry: &'a str,
    properties: &mut ObjectMembers<'a>,
) -> Result<FoundLandmark, MissionError> {
    let (corners, holes) = rings(text, geometry)?;
    let reference_place = properties.get("reference").map(|piece| piece.get());
    let reference: Option<LonLat> = text.take(properties, "reference")?;
    if let Some((longitude, latitude)) = reference
        && !on_globe(longitude, latitude)
    {
        return Err(text.error(
            reference_place.unwrap_or(feature),
            "the reference is not a longitude and a latitude in degrees",
        ));
    }
    Ok(FoundLandmark {
        reference,
        holes,
        id: own(text, properties, "id"),
        name: own(text, properties, "name"),
        height: text.take(properties, "height_m")?.unwrap_or(0.0),
        enabled: text.take(properties, "enabled")?.unwrap_or(true),
        ..FoundLandmark::new(LandmarkExtent::Corners(corners))
    })
}

/// A road.
fn road<'a>(
    text: &Text<'a>,
    geometry: &'a str,
    properties: &mut ObjectMembers<'a>,
) -> Result<FoundRoad, MissionError> {
    let line: Option<Geometry> = text.read(geometry)?;
    let positions: Vec<Vec<f64>> = match line.and_then(|line| line.coordinates) {
        Some(coordinates) => text.value(coordinates.get())?,
        None => Vec::new(),
    };
    let places = positions
        .iter()
        .map(|position| lon_lat(text, geometry, position, "a point of a road"));
    Ok(FoundRoad {
        name: own(text, properties, "name"),
        class: own(text, properties, HIGHWAY),
        width: own(text, properties, WIDTH),
        course: places.collect::<Result<_, _>>()?,
        properties: BTreeMap::new(),
    })
}

/// A rally point.
fn rally<'a>(
    text: &Text<'a>,
    geometry: &'a str,
    properties: &mut ObjectMembers<'a>,
) -> Result<FoundRally, MissionError> {
    let point: Option<Geometry> = text.read(geometry)?;
    let position: Vec<f64> = match point.and_then(|point| point.coordinates) {
        Some(coordinates) => text.value(coordinates.get())?,
        None => Vec::new(),
    };
    Ok(FoundRally {
        place: lon_lat(text, geometry, &position, "a rally point")?,
        name: own(text, properties, "name"),
        altitude: read_altitude(text, geometry, properties)?,
        properties: BTreeMap::new(),
    })
}

/// A route: a line, or a point or nothing where it has too few way-points for one.
fn route<'a>(
    text: &Text<'a>,
    geometry: &'a str,
    properties: &mut ObjectMembers<'a>,
) -> Result<ReadRoute, MissionError> {
    properties.remove(ROUTE_MARK.0);
    let line: Option<Geometry> = text.read(geometry)?;
    let positions: Vec<Vec<f64>> = match &line {
        None => Vec::new(),
        Some(Geometry {
            r#type: kind,
            coordinates: Some(coordinates),
        }) if kind == "LineString" => text.value(coordinates.get())?,
        Some(Geometry {
            r#type: kind,
            coordinates: Some(coordinates),
        }) if kind == "Point" => vec![text.value(coordinates.get())?],
        Some(_) => return Err(text.error(geometry, "a route is a LineString")),
    };
    let stated = match properties.remove("way_points") {
        Some(piece) => text.elements(piece.get())?,
        None => Vec::new(),
    };
    if stated.len() > positions.len() {
        return Err(text.error(
            stated[positions.len()].get(),
            format!(
                "more way-points than the line has points, {}",
                positions.len()
            ),
        ));
    }
    let mut way_points = Vec::with_capacity(positions.len());
    for (i, position) in positions.iter().enumerate() {
        let place = lon_lat(text, geometry, position, "a way-point")?;
        let way_point = match stated.get(i) {
            Some(piece) => read_way_point(text, piece.get())?,
            None => WayPoint::new(GroundPoint::default(), USUAL_ALTITUDE),
        };
        way_points.push((place, way_point));
    }
    Ok(ReadRoute {
        id: own(text, properties, "id"),
        name: own(text, properties, "name"),
        way_points,
        returns: own(text, properties, RETURNS).unwrap_or(false),
        ..ReadRoute::default()
    })
}
