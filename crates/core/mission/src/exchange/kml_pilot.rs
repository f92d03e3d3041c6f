//! Missions of DJI Pilot from before WPML: KML whose points are the way-points of a line, with speeds, heights and actions in a name
//! space of DJI's.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use super::item::counted;
use super::item_route::{GROUND_SPEED, OVER_GROUND};
use super::kml_data::data_of;
use super::kml_places::{place, tuples};
use super::xml::{NamedText, XmlElement};
use crate::mission::found::{LonLat, ReadRoute};
use crate::mission::{USUAL_ALTITUDE, WayPoint, WayPointAction};
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};

/// The name space.
const NAME_SPACE: &str = "www.dji.com";
/// Members by which a point is a way-point, and those by which a line is that of a mission.
const OF_POINT: [&str; 6] = [
    "useWaylineAltitude",
    "useWaylineSpeed",
    "useWaylinePointType",
    "pointType",
    "speed",
    "actions",
];
const OF_LINE: [&str; 4] = [
    "autoFlightSpeed",
    "actionOnFinish",
    "waypointType",
    "headingMode",
];
/// Action of staying, its parameter in milliseconds, and the word for a return at the end.
const HOVER: &str = "Hovering";
const GO_HOME: &str = "GoHome";
/// Farthest that a point and its place in the line are apart, degrees.
const SAME_DEGREES: f64 = 1e-6;

/// A mission as a document states it.
pub(super) struct PilotMission {
    /// First byte of the placemarks of the line and of its points.
    line: usize,
    points: BTreeSet<usize>,
    way_points: Vec<(LonLat, WayPoint)>,
    name: Option<String>,
    returns: bool,
    notes: Vec<String>,
}

/// A placemark with its data.
struct PilotMark<'a> {
    placemark: &'a XmlElement,
    data: &'a XmlElement,
    places: Vec<(LonLat, Option<f64>)>,
}

impl PilotMark<'_> {
    fn number(&self, name: &str) -> Option<f64> {
        let number = self.data.child_text(name)?.parse::<f64>().ok();
        number.filter(|number| number.is_finite())
    }

    /// Speed that it states, m/s.
    fn speed(&self, name: &str) -> Option<f64> {
        self.number(name).filter(|speed| *speed > 0.0)
    }

    /// Seconds for which it hovers, and names of other actions.
    fn actions(&self) -> (f64, Vec<String>) {
        let (mut seconds, mut others) = (0.0, Vec::new());
        for action in self.data.all("actions") {
            let parameter = action
                .attribute("param")
                .and_then(|p| p.parse::<f64>().ok());
            match parameter {
                Some(time) if action.text == HOVER && time > 0.0 => seconds += time / 1000.0,
                _ => others.push(action.text.clone()),
            }
        }
        (seconds, others)
    }
}

impl PilotMission {
    /// The mission of a document; `None` if it has none, or more than one, or points that are not those of its line.
    pub(super) fn find(source: &NamedText<'_>, root: &XmlElement) -> Option<Self> {
        if !source.text.contains(NAME_SPACE) {
            return None;
        }
        let mut placemarks = Vec::new();
        gather(root, &mut placemarks);
        let points = marks(&placemarks, "Point", &OF_POINT);
        let lines = marks(&placemarks, "LineString", &OF_LINE);
        let [line] = &lines[..] else {
            return None;
        };
        let near = |(point, (place, _)): (&PilotMark<'_>, &(LonLat, Option<f64>))| {
            let [(own, _)] = point.places[..] else {
                return false;
            };
            let apart = (own.0 - place.0).abs().max((own.1 - place.1).abs());
            apart < SAME_DEGREES
        };
        let is_same =
            points.len() == line.places.len() && points.iter().zip(&line.places).all(near);
        let name = || {
            find(root, "Document")?
                .child_text("name")
                .map(str::to_owned)
        };
        (is_same && !points.is_empty()).then(|| Self::of(source.text, line, &points, name()))
    }

    fn of(
        text: &str,
        line: &PilotMark<'_>,
        points: &[PilotMark<'_>],
        name: Option<String>,
    ) -> Self {
        let absolute = find(line.data, "useAbsolute").is_some_and(|e| e.text == "true");
        let (frame, from) = if absolute {
            (
                AltitudeFrame::Amsl,
                "are taken to count from mean sea level",
            )
        } else {
            (AltitudeFrame::AboveTakeOff, "count from take-off")
        };
        let mut notes = vec![format!(
            "this is a mission of DJI Pilot from before WPML: its points are the way-points of its line, and its heights {from}"
        )];
        let common = line.speed("autoFlightSpeed");
        let (mut speed, mut actions, mut way_points) = (None, Vec::new(), Vec::new());
        for (point, (place, height)) in points.iter().zip(&line.places) {
            let height = point.places[0].1.or(*height);
            let altitude = height.map_or(USUAL_ALTITUDE, |m| Altitude::new(m, frame));
            let mut way_point = WayPoint::new(GroundPoint::default(), altitude);
            // A file states the speed of the leg that leads away.
            way_point.speed = speed;
            way_point.properties = data_of(text, point.data).properties;
            if speed.is_some() {
                let mark = Value::Bool(true).to_string();
                way_point.properties.insert(GROUND_SPEED.to_owned(), mark);
            }
            let (seconds, others) = point.actions();
            if seconds > 0.0 {
                way_point.action = WayPointAction::Wait {
                    radius: 0.0,
                    seconds: Some(seconds),
                };
            }
            actions.extend(others);
            let own = point.speed("speed");
            let is_common = point.data.child_text("useWaylineSpeed") == Some("true");
            speed = own.filter(|_| !is_common).or(common);
            way_points.push((*place, way_point));
        }
        if way_points.iter().any(|(_, w)| w.speed.is_some()) {
            notes.push(OVER_GROUND.to_owned());
        }
        if !actions.is_empty() {
            let names = counted(&actions);
            notes.push(format!("actions are kept, and not shown: {names}"));
        }
        let finish = line.data.child_text("actionOnFinish");
        let returns = finish == Some(GO_HOME);
        notes.extend(finish.map(|finish| {
            if returns {
                format!("the aircraft returns home at the end ({finish})")
            } else {
                format!("what is done at the end is kept, and not shown: {finish}")
            }
        }));
        Self {
            line: line.placemark.begin,
            points: points.iter().map(|point| point.placemark.begin).collect(),
            way_points,
            name,
            returns,
            notes,
        }
    }

    /// Whether a placemark is one of its way-points.
    pub(super) fn has_point(&self, placemark: &XmlElement) -> bool {
        self.points.contains(&placemark.begin)
    }

    /// Whether a placemark is its line.
    pub(super) fn is_line(&self, placemark: &XmlElement) -> bool {
        self.line == placemark.begin
    }

    /// The mission as a route with what the placemark of its line says, and notes; its name is that of the document.
    pub(super) fn route(
        &self,
        name: Option<String>,
        properties: BTreeMap<String, String>,
    ) -> (ReadRoute, Vec<String>) {
        let route = ReadRoute {
            name: self.name.clone().or(name),
            properties,
            way_points: self.way_points.clone(),
            returns: self.returns,
            ..ReadRoute::default()
        };
        (route, self.notes.clone())
    }
}

/// The placemarks with that geometry whose data have one of these members.
fn marks<'a>(
    placemarks: &[&'a XmlElement],
    geometry: &str,
    members: &[&str],
) -> Vec<PilotMark<'a>> {
    let mark = |placemark: &&'a XmlElement| {
        let data = placemark.child("ExtendedData")?;
        let is_it = members.iter().any(|name| data.child(name).is_some());
        let coordinates = placemark.child(geometry)?.child("coordinates")?;
        let places = tuples(&coordinates.text);
        let places: Option<Vec<_>> = places.iter().map(|t| place(t.split(','))).collect();
        let places = places.filter(|_| is_it)?;
        Some(PilotMark {
            placemark,
            data,
            places,
        })
    };
    placemarks.iter().filter_map(mark).collect()
}

/// All placemarks, however deep they lie, in their order.
fn gather<'a>(element: &'a XmlElement, placemarks: &mut Vec<&'a XmlElement>) {
    for child in &element.children {
        if child.name == "Placemark" {
            placemarks.push(child);
        } else {
            gather(child, placemarks);
        }
    }
}

/// The first element of a name, at any depth.
fn find<'a>(element: &'a XmlElement, name: &str) -> Option<&'a XmlElement> {
    let deeper = || element.children.iter().find_map(|child| find(child, name));
    element.child(name).or_else(deeper)
}
