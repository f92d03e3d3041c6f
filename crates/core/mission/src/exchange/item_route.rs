//! Commands of a mission as a route, and a route as commands again.
//!
//! Commands that lead to a place are way-points; changes of speed are the speed of the legs behind
//! them. All others are kept as `QGroundControl` writes them, in the properties of the way-point
//! that they follow.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;
use serde_json::value::RawValue;

use super::item::{
    CHANGE_SPEED, Item, JUMP, RETURN_TO_LAUNCH, WAY_POINT, command_name, command_of, counted,
    frame_number,
};
use crate::mission::found::{FoundRoute, LonLat, on_globe};
use crate::mission::{Route, WayPoint, WayPointAction, globe};
use pilotage_base::frames::{Altitude, GroundPoint, LocalFrame};

/// Property of a way-point with the commands that follow it, and of a route with those before its
/// first way-point.
const THEN: &str = "mavlink_then";
const FIRST: &str = "mavlink_first";
/// Property of a way-point: the command, where it has more to say than the way-point.
const OWN: &str = "mavlink";
/// Property of a way-point: the speed of its leg is over ground.
const GROUND_SPEED: &str = "mavlink_ground_speed";
/// Property of a route: latitude, longitude and height of its home.
const HOME: &str = "home";
/// What stands among kept commands for the change of speed.
const SPEED_PLACE: &str = "\"speed\"";
/// Prefix of properties that are unknown members of a plan's command.
const MEMBER: &str = "plan:";

/// One step of a mission as a file states it.
pub(super) enum Step {
    /// A command.
    Command {
        /// What it is.
        item: Item,
        /// Its altitude where the file states it by other means than its parameters.
        altitude: Option<Altitude>,
        /// Members that we do not know, as JSON text.
        members: BTreeMap<String, String>,
        /// How `QGroundControl` writes it.
        text: String,
    },
    /// Something that is no command, such as a survey: its name and its text.
    Other(String, String),
}

/// The part of a command that a way-point cannot state.
#[derive(Deserialize)]
struct Own {
    command: u16,
    params: [Option<f64>; 4],
    #[serde(rename = "autoContinue")]
    is_continued: bool,
}

/// What follows a way-point and is none.
enum Between {
    Kept(String),
    Speed(Item, String),
}

/// Home of a mission: latitude and longitude in degrees, metres above mean sea level.
pub(super) type Home = [f64; 3];

/// The route that `steps` make, and notes on what is kept aside.
pub(super) fn route_of(steps: Vec<Step>, home: Option<Home>) -> (FoundRoute, Vec<String>) {
    let mut reader = Reader::default();
    let has_jumps = steps
        .iter()
        .any(|s| matches!(s, Step::Command { item, .. } if item.command == JUMP));
    for step in steps {
        match step {
            Step::Other(name, text) => {
                reader.unknown.push(name);
                reader.between.push(Between::Kept(text));
            }
            Step::Command {
                item,
                altitude,
                mut members,
                text,
            } => {
                if !has_jumps {
                    members.remove("doJumpId");
                }
                reader.command(item, altitude, &members, text, home);
            }
        }
    }
    reader.finish(home, has_jumps)
}

#[derive(Default)]
struct Reader {
    route: FoundRoute,
    between: Vec<Between>,
    speed: Option<f64>,
    unknown: Vec<String>,
    simplified: Vec<String>,
    ground_speeds: usize,
    returns: usize,
    at_home: usize,
}

impl Reader {
    fn command(
        &mut self,
        item: Item,
        altitude: Option<Altitude>,
        members: &BTreeMap<String, String>,
        text: String,
        home: Option<Home>,
    ) {
        if is_plain_speed(&item) {
            self.between.push(Between::Speed(item, text));
            return;
        }
        let altitude = item.altitude().map(|own| altitude.unwrap_or(own));
        let place = self.place(&item, home);
        let (Some(action), Some(altitude), Some(place)) = (item.action(), altitude, place) else {
            match item.command {
                RETURN_TO_LAUNCH => self.returns += 1,
                command => self.unknown.push(command_name(command)),
            }
            self.between.push(Between::Kept(text));
            return;
        };
        let mut way_point = WayPoint {
            action,
            ..WayPoint::new(GroundPoint::default(), altitude)
        };
        for (name, value) in members {
            way_point
                .properties
                .insert(format!("{MEMBER}{name}"), value.clone());
        }
        let (command, parameters) = command_of(&action);
        if (command, &parameters[..]) != (item.command, &item.parameters[..4]) || !item.is_continued
        {
            let parameters: Vec<String> = item.parameters[..4]
                .iter()
                .map(|p| Value::from(p.unwrap_or(f64::NAN)).to_string())
                .collect();
            let own = format!(
                "{{ \"command\": {}, \"params\": [{}], \"autoContinue\": {} }}",
                item.command,
                parameters.join(", "),
                item.is_continued
            );
            way_point.properties.insert(OWN.to_owned(), own);
        }
        if action == WayPointAction::FlyBy && item.command != WAY_POINT {
            self.simplified.push(command_name(item.command));
        }
        self.settle(Some(&mut way_point));
        way_point.speed = self.speed;
        self.route.way_points.push((place, way_point));
    }

    /// Where the command leads; a take-off that states no place is at home.
    fn place(&mut self, item: &Item, home: Option<Home>) -> Option<LonLat> {
        item.action()?;
        let (latitude, longitude) = (
            item.parameters[4].unwrap_or(0.0),
            item.parameters[5].unwrap_or(0.0),
        );
        if (latitude, longitude) != (0.0, 0.0) {
            return on_globe(longitude, latitude).then_some((longitude, latitude));
        }
        if item.action() == Some(WayPointAction::TakeOff) {
            self.at_home += 1;
            return home.map(|[latitude, longitude, _]| (longitude, latitude));
        }
        None
    }

    /// Gives what stands between two way-points to the first of them, or to the route where there
    /// is none; `next` is the second.
    fn settle(&mut self, next: Option<&mut WayPoint>) {
        let between = std::mem::take(&mut self.between);
        let speed_at = next.and_then(|next| {
            let at = between
                .iter()
                .rposition(|b| matches!(b, Between::Speed(..)))?;
            if let Between::Speed(item, _) = &between[at] {
                self.speed = item.parameters[1].filter(|v| *v > 0.0);
                if item.parameters[0] == Some(1.0) {
                    self.ground_speeds += 1;
                    let mark = "true".to_owned();
                    next.properties.insert(GROUND_SPEED.to_owned(), mark);
                }
            }
            Some(at)
        });
        let mut kept: Vec<String> = Vec::new();
        for (i, between) in between.into_iter().enumerate() {
            kept.push(match between {
                Between::Speed(..) if Some(i) == speed_at => SPEED_PLACE.to_owned(),
                Between::Kept(text) | Between::Speed(_, text) => text,
            });
        }
        // At the end is where it is written anyway.
        if kept.last().is_some_and(|text| text == SPEED_PLACE) {
            kept.pop();
        }
        if kept.is_empty() {
            return;
        }
        let list = format!("[{}]", kept.join(", "));
        match self.route.way_points.last_mut() {
            Some((_, last)) => last.properties.insert(THEN.to_owned(), list),
            None => self.route.properties.insert(FIRST.to_owned(), list),
        };
    }

    fn finish(mut self, home: Option<Home>, has_jumps: bool) -> (FoundRoute, Vec<String>) {
        self.settle(None);
        if let Some(home) = home {
            let home = Value::from(home.to_vec()).to_string();
            self.route.properties.insert(HOME.to_owned(), home);
        }
        let mut notes = Vec::new();
        let mut note = |names: &[String], one: &str, many: &str| {
            if !names.is_empty() {
                let (count, names) = (names.len(), counted(names));
                notes.push(match count {
                    1 => format!("{one}: {names}"),
                    _ => format!("{count} {many}: {names}"),
                });
            }
        };
        note(
            &self.unknown,
            "1 command is kept but not understood",
            "commands are kept but not understood",
        );
        note(
            &self.simplified,
            "1 command is shown as a way-point, and written again as it was",
            "commands are shown as way-points, and written again as they were",
        );
        if self.returns > 0 {
            notes.push("the return to launch is kept; the line of the route ends before it".into());
        }
        if self.at_home > 0 {
            notes.push("the take-off states no place: it is put at the home position".into());
        }
        if self.ground_speeds > 0 {
            notes.push(format!(
                "{} of the speeds are over ground; the prediction takes them for airspeeds",
                self.ground_speeds
            ));
        }
        if has_jumps {
            notes.push(
                "the mission jumps to commands by their numbers: check them after editing".into(),
            );
        }
        (self.route, notes)
    }
}

/// Whether a command does nothing but change the speed to a number, or back to the usual one.
fn is_plain_speed(item: &Item) -> bool {
    let [kind, speed, rest @ ..] = &item.parameters;
    item.command == CHANGE_SPEED
        && matches!(kind, None | Some(0.0 | 1.0))
        && speed.is_some_and(|v| v > 0.0 || v == -2.0)
        && rest.iter().all(|p| matches!(p, None | Some(0.0 | -1.0)))
}

/// One step of a route to be written.
pub(super) enum Written<'a> {
    /// A way-point: the command and where its altitude and unknown members stand.
    WayPoint(Item, &'a WayPoint),
    /// A change of speed.
    Speed(Item),
    /// What was kept, as `QGroundControl` writes it.
    Kept(&'a RawValue),
}

/// The steps of a route, in order.
pub(super) fn steps_of<'a>(route: &'a Route, frame: &LocalFrame) -> Vec<Written<'a>> {
    let mut steps = Vec::new();
    let mut speed = None;
    let mut before = kept(route.properties.get(FIRST));
    for way_point in &route.way_points {
        let change = (way_point.speed != speed).then(|| Written::Speed(speed_command(way_point)));
        speed = way_point.speed;
        between(&mut steps, &before, change);
        steps.push(Written::WayPoint(command(way_point, frame), way_point));
        before = kept(way_point.properties.get(THEN));
    }
    between(&mut steps, &before, None);
    steps
}

fn kept(list: Option<&String>) -> Vec<&RawValue> {
    // Properties that somebody wrote by hand may be no list; then nothing was kept.
    list.and_then(|text| serde_json::from_str(text).ok())
        .unwrap_or_default()
}

fn between<'a>(
    steps: &mut Vec<Written<'a>>,
    kept: &[&'a RawValue],
    mut change: Option<Written<'a>>,
) {
    for piece in kept {
        if piece.get() == SPEED_PLACE {
            steps.extend(change.take());
        } else {
            steps.push(Written::Kept(piece));
        }
    }
    steps.extend(change);
}

fn speed_command(way_point: &WayPoint) -> Item {
    let is_over_ground = way_point.properties.contains_key(GROUND_SPEED);
    let zero = Some(0.0);
    // A speed of -2 is the vehicle's usual one, a throttle of -1 leaves the throttle alone.
    let speed = Some(way_point.speed.unwrap_or(-2.0));
    let kind = Some(f64::from(u8::from(is_over_ground)));
    Item {
        command: CHANGE_SPEED,
        frame: 2,
        parameters: [kind, speed, Some(-1.0), zero, zero, zero, zero],
        is_continued: true,
    }
}

fn command(way_point: &WayPoint, frame: &LocalFrame) -> Item {
    let (longitude, latitude) = globe::lon_lat(frame, &way_point.position);
    let (command, own) = command_of(&way_point.action);
    let rounded = |degrees: f64| Some((degrees * 1e10).round() / 1e10);
    let mut item = Item {
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
    if let Some(own) = kept.and_then(|text| serde_json::from_str::<Own>(text).ok()) {
        let mut before = item.clone();
        before.command = own.command;
        before.parameters[..4].copy_from_slice(&own.params);
        let is_same = before.action().map(|a| std::mem::discriminant(&a))
            == Some(std::mem::discriminant(&way_point.action));
        if is_same {
            item.command = own.command;
            item.is_continued = own.is_continued;
            item.parameters[..4].copy_from_slice(&own.params);
            if let WayPointAction::Loiter { radius, turns } = way_point.action {
                item.parameters[0] = Some(turns);
                item.parameters[2] = Some(radius);
            }
        }
    }
    item
}

/// Members of a plan's command that we do not know, from a way-point's properties.
pub(super) fn members(way_point: &WayPoint) -> impl Iterator<Item = (&str, &String)> {
    way_point
        .properties
        .iter()
        .filter_map(|(name, value)| Some((name.strip_prefix(MEMBER)?, value)))
}

/// The home that a route keeps, or else its first way-point, of which the height is not known.
pub(super) fn home_of(route: &Route, frame: &LocalFrame) -> Option<Home> {
    let kept = route.properties.get(HOME);
    if let Some(home) = kept.and_then(|text| serde_json::from_str::<Home>(text).ok()) {
        return Some(home);
    }
    let first = route.way_points.first()?;
    let (longitude, latitude) = globe::lon_lat(frame, &first.position);
    Some([latitude, longitude, 0.0])
}
