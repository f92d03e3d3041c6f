//! Rally points of a plan and of lines of way-points: the place and the altitude of each.
//!
//! <https://docs.qgroundcontrol.com/master/en/qgc-dev-guide/file_formats/plan.html>,
//! <https://mavlink.io/en/messages/common.html#MAV_CMD_NAV_RALLY_POINT>

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::Places;
use super::item::{MissionItem, frame_number, frame_of_number};
use crate::mission::found::{FoundRally, LonLat, on_globe};
use crate::mission::{RallyPoint, globe};
use pilotage_base::frames::{Altitude, AltitudeFrame, LocalFrame};

pub(super) const RALLY_POINT: u16 = 5100;
/// Property of a rally point: its command, where it has more to say than the place.
const OWN: &str = "mavlink";
/// Places so near each other are the same, degrees; altitudes, metres.
const SAME_DEGREES: f64 = 1e-7;
const SAME_METRES: f64 = 1e-3;

/// The part of a rally point's command that it cannot state itself.
#[derive(Serialize, Deserialize)]
struct RallyRemainder {
    params: [Option<f64>; 4],
    frame: u8,
    #[serde(rename = "autoContinue")]
    is_continued: bool,
}

/// The rally point of a command; `None` if it is none, or has no place on the globe.
pub(super) fn of_item(item: &MissionItem) -> Option<FoundRally> {
    let [a, b, c, d, latitude, longitude, metres] = item.parameters;
    let place = (longitude?, latitude?);
    let altitude = Altitude::new(metres.unwrap_or(0.0), frame_of_number(item.frame)?);
    if item.command != RALLY_POINT || !on_globe(place.0, place.1) {
        return None;
    }
    let own = RallyRemainder {
        params: [a, b, c, d],
        frame: item.frame,
        is_continued: item.is_continued,
    };
    let own = serde_json::to_string(&own).ok();
    Some(FoundRally {
        name: None,
        place,
        altitude,
        properties: own.map(|own| (OWN.to_owned(), own)).into_iter().collect(),
    })
}

/// The points of lines `RALLY`, latitude, longitude and metres above take-off, as ground stations of ArduPilot keep them
/// (`.ral`); `None` of any other text.
pub(super) fn of_lines(content: &str) -> Option<Vec<FoundRally>> {
    let is_told = |line: &&str| !line.trim().is_empty() && !line.starts_with('#');
    let point = |line: &str| {
        let mut words = line.split_ascii_whitespace();
        words.next().filter(|word| *word == "RALLY")?;
        let mut number = || words.next()?.parse::<f64>().ok();
        let (latitude, longitude, metres) = (number()?, number()?, number()?);
        on_globe(longitude, latitude).then(|| FoundRally {
            name: None,
            place: (longitude, latitude),
            altitude: Altitude::new(metres, AltitudeFrame::AboveTakeOff),
            properties: BTreeMap::default(),
        })
    };
    let points: Option<Vec<FoundRally>> = content.lines().filter(is_told).map(point).collect();
    points.filter(|points| !points.is_empty())
}

/// The command of a rally point.
pub(super) fn item_of(point: &RallyPoint, frame: &LocalFrame) -> MissionItem {
    let own = point.properties.get(OWN);
    let own: Option<RallyRemainder> = own.and_then(|text| serde_json::from_str(text).ok());
    let (longitude, latitude) = globe::lon_lat(frame, &point.position);
    let rounded = |degrees: f64| Some((degrees * 1e10).round() / 1e10);
    let [a, b, c, d] = own.as_ref().map_or([Some(0.0); 4], |own| own.params);
    let mut item = MissionItem {
        command: RALLY_POINT,
        frame: frame_number(point.altitude.frame),
        parameters: [
            a,
            b,
            c,
            d,
            rounded(latitude),
            rounded(longitude),
            Some(point.altitude.metres),
        ],
        is_continued: own.as_ref().is_none_or(|own| own.is_continued),
    };
    if let Some(own) = own {
        let stated = MissionItem {
            frame: own.frame,
            ..item.clone()
        };
        if stated.altitude() == item.altitude() {
            item.frame = own.frame;
        }
    }
    item
}

/// Whether a command is one of the rally points of a mission.
pub(super) fn is_among(item: &MissionItem, points: &[RallyPoint], frame: &LocalFrame) -> bool {
    of_item(item).is_some_and(|found| points.iter().any(|point| is_same(&found, point, frame)))
}

fn is_same(found: &FoundRally, point: &RallyPoint, frame: &LocalFrame) -> bool {
    let (longitude, latitude) = globe::lon_lat(frame, &point.position);
    (found.place.0 - longitude).abs() < SAME_DEGREES
        && (found.place.1 - latitude).abs() < SAME_DEGREES
        && found.altitude.frame == point.altitude.frame
        && (found.altitude.metres - point.altitude.metres).abs() < SAME_METRES
}

/// A point of a plan: latitude, longitude and metres above home.
fn of_array(value: &Value) -> Option<FoundRally> {
    let number = |i: usize| value.get(i).and_then(Value::as_f64);
    let place: LonLat = (number(1)?, number(0)?);
    let metres = number(2).unwrap_or(0.0);
    on_globe(place.0, place.1).then(|| FoundRally {
        name: None,
        place,
        altitude: Altitude::new(metres, AltitudeFrame::AboveTakeOff),
        properties: std::collections::BTreeMap::new(),
    })
}

/// Rally points of a plan, the member `rallyPoints`, and the number of those that are no places.
pub(super) fn of_plan(text: &str) -> (Vec<FoundRally>, usize) {
    let stated: Option<Value> = serde_json::from_str(text).ok();
    let points = stated
        .as_ref()
        .and_then(|stated| stated.get("points")?.as_array());
    let points = points.map_or(&[][..], Vec::as_slice);
    let found: Vec<FoundRally> = points.iter().filter_map(of_array).collect();
    let broken = points.len() - found.len();
    (found, broken)
}

/// The member `rallyPoints` of a plan with `points`, of which those that the plan had before (`kept`) stand as they stood;
/// and a note on altitudes that it cannot hold.
pub(super) fn in_plan(
    kept: &str,
    points: &[RallyPoint],
    home: Option<f64>,
    frame: &LocalFrame,
) -> (String, Option<String>) {
    let is_above_home = |point: &RallyPoint| {
        point.altitude.frame == AltitudeFrame::AboveTakeOff
            || point.altitude.frame == AltitudeFrame::Amsl && home.is_some()
    };
    let others = points.iter().filter(|point| !is_above_home(point)).count();
    let note = (others > 0).then(|| {
        format!("{others} × altitude of a rally point is written as if it counted from take-off")
    });
    let above_home = |point: &RallyPoint| {
        let below = home.filter(|_| point.altitude.frame == AltitudeFrame::Amsl);
        let metres = point.altitude.metres - below.unwrap_or(0.0);
        RallyPoint {
            altitude: Altitude::new(metres, AltitudeFrame::AboveTakeOff),
            ..point.clone()
        }
    };
    let points: Vec<RallyPoint> = points.iter().map(above_home).collect();
    let Ok(mut stated) = serde_json::from_str::<Value>(kept) else {
        return (kept.to_owned(), note);
    };
    let Some(list) = stated.get_mut("points").and_then(Value::as_array_mut) else {
        return (kept.to_owned(), note);
    };
    let before = list.clone();
    // What is no place is nobody's to take away.
    list.retain(|value| {
        of_array(value).is_none_or(|found| points.iter().any(|p| is_same(&found, p, frame)))
    });
    let had: Vec<FoundRally> = before.iter().filter_map(of_array).collect();
    let nine = |degrees: f64| (degrees * 1e9).round() / 1e9;
    for point in points
        .iter()
        .filter(|point| !had.iter().any(|found| is_same(found, point, frame)))
    {
        let (longitude, latitude) = globe::lon_lat(frame, &point.position);
        list.push(json!([
            nine(latitude),
            nine(longitude),
            point.altitude.metres
        ]));
    }
    let is_as_before = *list == before;
    let text = if is_as_before {
        kept.to_owned()
    } else {
        stated.to_string()
    };
    (text, note)
}

/// That rally points are left out, of a file that has none.
pub(super) fn left_out(places: &Places<'_>) -> Option<String> {
    let count = places.rally.map_or(0, <[RallyPoint]>::len);
    (count > 0).then(|| {
        format!("{count} × rally point is left out: plans, KML, GPX and GeoJSON have them")
    })
}
