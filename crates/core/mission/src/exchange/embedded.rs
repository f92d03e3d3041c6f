//! Properties of a route or landmark that we know, inside another format: the properties of its GeoJSON
//! feature as JSON text. Names and places come from the format itself, so that what other programs change in
//! the file is heeded.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};

use crate::mission::found::{FoundLandmark, FoundNoFly, FoundRally, LonLat, ReadRoute};
use crate::mission::text::Text;
use crate::mission::{
    NoFlyZone, RallyPoint, Route, no_fly_feature, rally_feature, read_features, write_features,
};
use pilotage_base::frames::LocalFrame;
use pilotage_vision::landmark::Landmark;

/// Contents of a feature: the properties that are ours, and unknown ones that are plain text.
pub(super) struct Embedded {
    /// Our properties, as a JSON object.
    pub own: String,
    /// Unknown properties that are text.
    pub texts: BTreeMap<String, String>,
}

/// Embeds a route.
pub(super) fn of_route(route: &Route, frame: &LocalFrame) -> Embedded {
    split(&write_features(std::slice::from_ref(route), &[], frame))
}

/// Properties to embed for a route where plain text has no place of its own.
pub(super) fn of_route_whole(route: &Route, frame: &LocalFrame) -> String {
    let features = write_features(std::slice::from_ref(route), &[], frame);
    whole(features.first().map_or("{}", String::as_str))
}

/// Embeds a landmark.
pub(super) fn of_landmark(landmark: &Landmark, frame: &LocalFrame) -> Embedded {
    split(&write_features(&[], std::slice::from_ref(landmark), frame))
}

/// The area that must not be flown over, to be embedded.
pub(super) fn of_no_fly(zone: &NoFlyZone, frame: &LocalFrame) -> Embedded {
    split(&[no_fly_feature(zone, frame)])
}

/// The rally point, to be embedded.
pub(super) fn of_rally(point: &RallyPoint, frame: &LocalFrame) -> Embedded {
    split(&[rally_feature(point, frame)])
}

/// Properties to embed for a rally point where plain text has no place of its own.
pub(super) fn of_rally_whole(point: &RallyPoint, frame: &LocalFrame) -> String {
    whole(&rally_feature(point, frame))
}

fn whole(feature: &str) -> String {
    let feature: Value = serde_json::from_str(feature).unwrap_or_default();
    feature["properties"].to_string()
}

fn split(features: &[String]) -> Embedded {
    let feature = features.first().map_or("{}", String::as_str);
    let feature: Value = serde_json::from_str(feature).unwrap_or_default();
    let mut own = Map::new();
    let mut texts = BTreeMap::new();
    let properties = feature
        .get("properties")
        .and_then(Value::as_object)
        .cloned();
    for (name, value) in properties.unwrap_or_default() {
        match value {
            // The name stands in the format itself.
            _ if name == "name" => {}
            Value::String(text) if !["pilotage", "altitude_frame"].contains(&name.as_str()) => {
                texts.insert(name, text);
            }
            value => {
                own.insert(name, value);
            }
        }
    }
    Embedded {
        own: Value::Object(own).to_string(),
        texts,
    }
}

/// The route or landmark of which `own` was embedded, with the places that the file states.
///
/// The second is whether the line has another number of points than it had, and what way-points
/// state is lost. `None` if the text is none of ours.
pub(super) fn read(
    own: &str,
    places: &[LonLat],
    holes: &[Vec<LonLat>],
) -> Option<(EmbeddedItem, bool)> {
    let mut properties: Map<String, Value> = serde_json::from_str(own).ok()?;
    let is_route = properties
        .get("pilotage")
        .is_some_and(|mark| mark == "route");
    let stated = properties.get("way_points").and_then(Value::as_array);
    let is_changed = is_route && stated.is_some_and(|list| list.len() != places.len());
    if is_changed {
        properties.remove("way_points");
    }
    let ring = |places: &[LonLat]| -> Vec<[f64; 2]> { places.iter().map(|p| [p.0, p.1]).collect() };
    let positions = ring(places);
    let rings: Vec<_> = std::iter::once(places)
        .chain(holes.iter().map(Vec::as_slice))
        .map(ring)
        .collect();
    let geometry = match (is_route, places) {
        (true, []) => Value::Null,
        (_, [(longitude, latitude)]) => {
            json!({ "type": "Point", "coordinates": [longitude, latitude] })
        }
        (true, _) => json!({ "type": "LineString", "coordinates": positions }),
        (false, _) => json!({ "type": "Polygon", "coordinates": rings }),
    };
    let collection = json!({ "type": "FeatureCollection", "features": [
        { "type": "Feature", "geometry": geometry, "properties": properties }
    ] });
    let content = collection.to_string();
    let (mut features, _) = read_features(&Text(&content)).ok()?;
    let route = features.routes.pop().map(EmbeddedItem::Route);
    let no_fly = features.no_fly.pop().map(EmbeddedItem::NoFly);
    let rally = features.rally.pop().map(EmbeddedItem::Rally);
    let item = route
        .or(no_fly)
        .or(rally)
        .or_else(|| features.landmarks.pop().map(EmbeddedItem::Landmark))?;
    Some((item, is_changed))
}

/// Item that was embedded.
pub(super) enum EmbeddedItem {
    /// A route.
    Route(ReadRoute),
    /// A landmark.
    Landmark(FoundLandmark),
    /// An area that must not be flown over.
    NoFly(FoundNoFly),
    /// A rally point.
    Rally(FoundRally),
}
