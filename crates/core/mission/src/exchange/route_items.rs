//! A route as the commands of a mission, as `item_route` has read them.

use std::collections::BTreeMap;

use serde_json::Value;
use serde_json::value::RawValue;

use super::complex::{self, InnerCommand};
use super::item::{MissionItem, WAY_POINT, command_of, frame_number, return_to_launch};
use super::item_route::{
    AT_HOME, CommandRemainder, FIRST, GROUND_SPEED, Home, MEMBER, OWN, RETURN, SPEED_MEMBER,
    SPEED_PLACE, THEN, is_plain_speed,
};
use super::speed_command::change_of_speed;
use crate::mission::{Route, WayPoint, WayPointAction, globe};
use pilotage_base::frames::LocalFrame;

/// Farthest from home that a way-point counts as left there, metres: what rounding may do to it.
const STILL_AT_HOME: f64 = 0.01;

/// Step of a route to be written.
pub(super) enum RouteStep<'a> {
    /// A way-point: the command and where its altitude and unknown members stand.
    WayPoint(MissionItem, &'a WayPoint),
    /// A change of speed, and the number by which the file that it comes from names it.
    Speed(MissionItem, Option<usize>),
    /// Kept command, as `QGroundControl` writes it.
    Kept(&'a RawValue),
    /// The return to launch where no file said how.
    Return(MissionItem),
}

impl RouteStep<'_> {
    /// The number by which jumps name it, if the file that it comes from gave it one.
    pub(super) fn jump_id(&self) -> Option<usize> {
        match self {
            Self::Speed(_, id) => *id,
            Self::WayPoint(_, way_point) => members(way_point)
                .find(|(name, _)| *name == "doJumpId")
                .and_then(|(_, value)| value.parse().ok()),
            Self::Kept(piece) => jump_id_of(piece.get()),
            Self::Return(_) => None,
        }
    }
}

fn jump_id_of(text: &str) -> Option<usize> {
    let value: Value = serde_json::from_str(text).ok()?;
    usize::try_from(value.get("doJumpId")?.as_u64()?).ok()
}

/// The steps of a route, in order; surveys and the like as the commands that they stand for.
pub(super) fn steps_of<'a>(route: &'a Route, frame: &LocalFrame) -> Vec<RouteStep<'a>> {
    steps(route, frame, &[])
}

/// The steps of a route, in order, with surveys and the like as they were, unless somebody changed them.
pub(super) fn steps_of_plan<'a>(route: &'a Route, frame: &LocalFrame) -> Vec<RouteStep<'a>> {
    steps(route, frame, &complex::unchanged(route, frame))
}

/// The steps of a route; `whole` are what stands for several commands and is written as it is.
fn steps<'a>(
    route: &'a Route,
    frame: &LocalFrame,
    whole: &[Option<&'a RawValue>],
) -> Vec<RouteStep<'a>> {
    let home = route.stated_home();
    let mut steps = Vec::new();
    let mut speed = None;
    let in_whole = |number: usize| whole.get(number).copied().flatten();
    let outside = |pieces: Vec<&'a RawValue>| -> Vec<&'a RawValue> {
        let of = |piece: &'a RawValue| match serde_json::from_str::<InnerCommand>(piece.get()) {
            Ok(inside) if in_whole(inside.complex).is_some() => None,
            Ok(inside) => Some(inside.item),
            Err(_) => Some(piece),
        };
        pieces.into_iter().filter_map(of).collect()
    };
    let mut last = None;
    let mut before = outside(kept(route.properties.get(FIRST)));
    for way_point in &route.way_points {
        between(&mut steps, &before, Some((way_point, speed)));
        speed = way_point.speed;
        let number = complex::number(way_point).filter(|number| in_whole(*number).is_some());
        match number.and_then(in_whole) {
            Some(_) if number == last => {}
            Some(item) => steps.push(RouteStep::Kept(item)),
            None => steps.push(RouteStep::WayPoint(
                command(way_point, frame, home),
                way_point,
            )),
        }
        last = number;
        before = outside(kept(way_point.properties.get(THEN)));
    }
    between(&mut steps, &before, None);
    if route.returns {
        let own = route.properties.get(RETURN);
        let own = own.and_then(|text| serde_json::from_str(text).ok());
        steps.push(own.map_or_else(|| RouteStep::Return(return_to_launch()), RouteStep::Kept));
    }
    steps
}

fn kept(list: Option<&String>) -> Vec<&RawValue> {
    // Properties that somebody wrote by hand may be no list; then nothing was kept.
    list.and_then(|text| serde_json::from_str(text).ok())
        .unwrap_or_default()
}

/// Adds what was kept before the way-point `next`, whose leg has another speed than that before it or
/// has not; the change stands where it stood in the file, as long as it says the same.
fn between<'a>(
    steps: &mut Vec<RouteStep<'a>>,
    kept: &[&'a RawValue],
    next: Option<(&WayPoint, Option<f64>)>,
) {
    let mut change = next
        .filter(|(next, before)| next.speed != *before)
        .map(|(next, _)| RouteStep::Speed(speed_command(next), None));
    for piece in kept {
        if piece.get() == SPEED_PLACE {
            steps.extend(change.take());
        } else if let Some((item, id)) = kept_speed(piece.get()) {
            let wanted = next.and_then(|(next, _)| next.speed);
            if next.is_some() && item.parameters[1].filter(|v| *v > 0.0) == wanted {
                steps.push(RouteStep::Speed(item, id));
                change = None;
            } else if let Some(RouteStep::Speed(item, _)) = change.take() {
                steps.push(RouteStep::Speed(item, id));
            }
        } else {
            steps.push(RouteStep::Kept(piece));
        }
    }
    steps.extend(change);
}

/// The change of speed that stands among kept commands, and its number.
fn kept_speed(text: &str) -> Option<(MissionItem, Option<usize>)> {
    let members: BTreeMap<&str, &RawValue> = serde_json::from_str(text).ok()?;
    let own = members.get(SPEED_MEMBER)?.get();
    let item = MissionItem::of_json(own).ok().filter(is_plain_speed)?;
    Some((item, jump_id_of(own)))
}

fn speed_command(way_point: &WayPoint) -> MissionItem {
    let is_over_ground = way_point.properties.contains_key(GROUND_SPEED);
    change_of_speed(way_point.speed, is_over_ground)
}

fn command(way_point: &WayPoint, frame: &LocalFrame, home: Option<Home>) -> MissionItem {
    let (longitude, latitude) = globe::lon_lat(frame, &way_point.position);
    let (command, own) = command_of(&way_point.action);
    let rounded = |degrees: f64| Some((degrees * 1e10).round() / 1e10);
    let mut item = MissionItem {
        command,
        frame: frame_number(way_point.altitude.frame),
        parameters: [
            own[0],
            own[1],
            own[2],
            own[3],
            rounded(latitude),
            rounded(longitude),
            Some(way_point.altitude.metres),
        ],
        is_continued: true,
    };
    let kept = way_point.properties.get(OWN);
    if let Some(own) = kept.and_then(|text| serde_json::from_str::<CommandRemainder>(text).ok()) {
        let mut before = item.clone();
        before.command = own.command;
        before.parameters[..4].copy_from_slice(&own.params);
        if can_state(&before, &way_point.action) {
            item.command = own.command;
            item.is_continued = own.is_continued;
            item.parameters[..4].copy_from_slice(&own.params);
            state_circles(&mut item, &way_point.action);
        }
    }
    let is_at_home = home.is_some_and(|[latitude, longitude, _]| {
        let home = globe::ground(frame, longitude, latitude);
        home.distance(&way_point.position) < STILL_AT_HOME
    });
    if is_at_home && way_point.properties.contains_key(AT_HOME) {
        item.parameters[4] = Some(0.0);
        item.parameters[5] = Some(0.0);
    }
    item
}

/// Whether the command of a way-point, as a file had it, can state the action that it has.
fn can_state(own: &MissionItem, action: &WayPointAction) -> bool {
    match (own.action(), action) {
        (
            Some(WayPointAction::Wait {
                seconds: own_time, ..
            }),
            WayPointAction::Wait { radius, seconds },
        ) => {
            // Rotorcraft stay at a way-point without circles.
            own_time.is_some() == seconds.is_some() && (own.command != WAY_POINT || *radius == 0.0)
        }
        (Some(own), action) => std::mem::discriminant(&own) == std::mem::discriminant(action),
        (None, _) => false,
    }
}

/// States the circles of an action in the command that it has.
fn state_circles(item: &mut MissionItem, action: &WayPointAction) {
    match *action {
        WayPointAction::Loiter { radius, turns } => {
            item.parameters[0] = Some(turns);
            item.parameters[2] = Some(radius);
        }
        WayPointAction::Wait { radius, seconds } => {
            if seconds.is_some() {
                item.parameters[0] = seconds;
            }
            if item.command != WAY_POINT {
                item.parameters[2] = Some(radius);
            }
        }
        _ => {}
    }
}

/// Members of a plan's command that we do not know, from a way-point's properties.
pub(super) fn members(way_point: &WayPoint) -> impl Iterator<Item = (&str, &String)> {
    way_point
        .properties
        .iter()
        .filter_map(|(name, value)| Some((name.strip_prefix(MEMBER)?, value)))
}

/// The home that a route keeps; without one that of its first way-point, of which the height is not
/// known.
pub(super) fn home_of(route: &Route, frame: &LocalFrame) -> Option<Home> {
    route.stated_home().or_else(|| {
        let first = route.way_points.first()?;
        let (longitude, latitude) = globe::lon_lat(frame, &first.position);
        Some([latitude, longitude, 0.0])
    })
}
