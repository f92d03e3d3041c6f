//! Items of a plan that stand for several commands: surveys, corridors and landing patterns, with the
//! commands that `QGroundControl` stored in them or makes of them.
//!
//! A route holds the way-points of such an item, and the item itself, which is written again as it stands as
//! long as none of them was changed.

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use serde_json::{Value, json};

use super::item::frame_number;
use crate::mission::found::LonLat;
use crate::mission::{Route, WayPoint, globe};
use pilotage_base::frames::LocalFrame;

/// Property of a route with its items of that kind, and of a way-point with the number of that to which it belongs.
pub(super) const COMPLEX: &str = "mavlink_complex";
/// Farthest from its place that a way-point counts as left there, metres.
const UNMOVED: f64 = 0.01;

/// An item as a route keeps it.
#[derive(Serialize, Deserialize)]
pub(super) struct Complex<'a> {
    /// Its text.
    #[serde(borrow)]
    pub item: &'a RawValue,
    /// Latitude, longitude, altitude and frame of its way-points.
    pub way_points: Vec<[f64; 4]>,
}

/// A command inside of such an item that is no way-point.
#[derive(Serialize, Deserialize)]
pub(super) struct InnerCommand<'a> {
    /// Number of the item.
    pub complex: usize,
    /// The command.
    #[serde(borrow)]
    pub item: &'a RawValue,
}

/// Texts of the commands in an item, the ones that are stored or those that it stands for; none if it
/// stores none, such as a structure scan, or is not known.
pub(super) fn commands(text: &str) -> Vec<String> {
    let Ok(item) = serde_json::from_str::<Value>(text) else {
        return Vec::new();
    };
    let stored = item
        .get("TransectStyleComplexItem")
        .unwrap_or(&item)
        .get("Items");
    if let Some(stored) = stored.and_then(Value::as_array) {
        return stored.iter().map(Value::to_string).collect();
    }
    let kind = item.get("complexItemType").and_then(Value::as_str);
    // Some versions write it with capitals.
    let land = match kind.map(str::to_ascii_lowercase).as_deref() {
        Some("fwlandingpattern") => super::item::LAND,
        Some("vtollandingpattern") => super::item::VTOL_LAND,
        _ => return Vec::new(),
    };
    landing(&item, land).unwrap_or_default()
}

/// The commands of a landing pattern: its beginning, the approach and the landing.
fn landing(item: &Value, land: u16) -> Option<Vec<String>> {
    let place = |name: &str| -> Option<[f64; 3]> {
        let numbers = item.get(name)?.as_array()?;
        let number = |i: usize| numbers.get(i).and_then(Value::as_f64);
        Some([number(0)?, number(1)?, number(2).unwrap_or(0.0)])
    };
    let is = |name: &str, usual: bool| item.get(name).and_then(Value::as_bool).unwrap_or(usual);
    // Plans of QGroundControl before 4.1 call the approach so.
    let approach = place("landingApproachCoordinate").or_else(|| place("loiterCoordinate"))?;
    let touch_down = place("landCoordinate")?;
    // Older ones say of each height what it counts from.
    let frame = |old: &str| {
        let is_relative = is("altitudesAreRelative", is(old, true));
        if is_relative { 3 } else { 0 }
    };
    let above = frame("loiterAltitudeRelative");
    let below = frame("landAltitudeRelative");
    let radius = item
        .get("loiterRadius")
        .and_then(Value::as_f64)
        .unwrap_or(0.0);
    let radius = if is("loiterClockwise", true) {
        radius
    } else {
        -radius
    };
    let command = |command: u16, frame: u8, own: [Value; 4], place: [f64; 3]| {
        let parameters: Vec<Value> = own.into_iter().chain(place.map(Value::from)).collect();
        let simple = json!({
            "autoContinue": true, "command": command, "frame": frame, "params": parameters,
            "type": "SimpleItem",
        });
        simple.to_string()
    };
    let zeros = || [0, 0, 0, 0].map(Value::from);
    let approach = if is("useLoiterToAlt", true) {
        let own = [json!(1), json!(radius), json!(0), json!(1)];
        command(super::item::LOITER_TO_ALTITUDE, above, own, approach)
    } else {
        command(super::item::WAY_POINT, above, zeros(), approach)
    };
    Some(vec![
        command(super::item::LAND_START, 2, zeros(), [0.0; 3]),
        approach,
        command(land, below, zeros(), touch_down),
    ])
}

/// The numbers of a way-point that are kept, to see whether it was changed.
pub(super) fn stamp(place: LonLat, way_point: &WayPoint) -> [f64; 4] {
    let altitude = &way_point.altitude;
    let frame = f64::from(frame_number(altitude.frame));
    [place.1, place.0, altitude.metres, frame]
}

/// Number of the item to which a way-point belongs.
pub(super) fn number(way_point: &WayPoint) -> Option<usize> {
    way_point.properties.get(COMPLEX)?.parse().ok()
}

/// The items of a route, `None` in place of those whose way-points were changed.
pub(super) fn unchanged<'a>(route: &'a Route, frame: &LocalFrame) -> Vec<Option<&'a RawValue>> {
    let kept = route.properties.get(COMPLEX);
    let kept: Vec<Complex> = kept
        .and_then(|text| serde_json::from_str(text).ok())
        .unwrap_or_default();
    let numbers: Vec<Option<usize>> = route.way_points.iter().map(number).collect();
    let is_same = |(k, complex): (usize, &Complex<'a>)| {
        let first = numbers.iter().position(|own| *own == Some(k))?;
        let count = numbers.iter().filter(|own| **own == Some(k)).count();
        // They have to follow each other.
        let own = route
            .way_points
            .get(first..first + complex.way_points.len())?;
        let same = |(w, [latitude, longitude, metres, number]): (&WayPoint, &[f64; 4])| {
            let place = globe::ground(frame, *longitude, *latitude);
            let altitude = &w.altitude;
            place.distance(&w.position) < UNMOVED
                && altitude.metres.total_cmp(metres).is_eq()
                && f64::from(frame_number(altitude.frame))
                    .total_cmp(number)
                    .is_eq()
                && w.speed == own[0].speed
        };
        let is_own = own.iter().all(|w| number(w) == Some(k));
        let is_whole = count == complex.way_points.len() && is_own;
        (is_whole && own.iter().zip(&complex.way_points).all(same)).then_some(complex.item)
    };
    kept.iter().enumerate().map(is_same).collect()
}
