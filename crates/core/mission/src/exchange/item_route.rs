//! Commands of a mission as a route; `route_items` makes commands of it again.
//!
//! Commands that lead to a place are way-points; changes of speed are the speed of the legs behind
//! them. All others are kept as `QGroundControl` writes them, in the properties of the way-point
//! that they follow.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

use super::complex::{self, COMPLEX, Complex};
use super::fence::is_fence;
use super::item::{
    CHANGE_SPEED, JUMP, MissionItem, RETURN_TO_LAUNCH, WAY_POINT, command_name, command_of,
    counted, frame_of_number,
};
use super::speed_command::is_usual_speed;
use crate::mission::found::{LonLat, ReadRoute, on_globe};
use crate::mission::{HOME, WayPoint, WayPointAction};
use pilotage_base::frames::{Altitude, GroundPoint};

/// Property of a way-point with the commands that follow it, and of a route with those before its
/// first way-point.
pub(super) const THEN: &str = "mavlink_then";
pub(super) const FIRST: &str = "mavlink_first";
/// Property of a way-point: the command, where it has more to say than the way-point.
pub(super) const OWN: &str = "mavlink";
/// Property of a way-point: the speed of its leg is over ground.
pub(super) const GROUND_SPEED: &str = "mavlink_ground_speed";
/// Note on speeds of files in which all are over ground.
pub(super) const OVER_GROUND: &str =
    "the speeds are over ground; the prediction takes them for airspeeds";
/// Property of a route: the return to launch at its end, as the file had it.
pub(super) const RETURN: &str = "mavlink_return";
/// Property of a route: what only a file of way-points says of it.
pub(super) const WPL: &str = "wpl";
/// Placeholder among kept commands for the change of speed in files of earlier versions; now its own command
/// stands there, in an object of one member of that name.
pub(super) const SPEED_PLACE: &str = "\"speed\"";
pub(super) const SPEED_MEMBER: &str = "speed";
/// Property of a way-point: its command states no place, because the place is that of home.
pub(super) const AT_HOME: &str = "mavlink_at_home";
/// Property of a way-point: its command states no altitude, because that of the way-point before is meant.
pub(super) const SAME_ALTITUDE: &str = "mavlink_same_altitude";
/// Prefix of properties that are unknown members of a plan's command.
pub(super) const MEMBER: &str = "plan:";

/// Step of a mission as a file states it.
pub(super) enum MissionStep {
    /// A command.
    Command {
        /// Command as `MAVLink` numbers it.
        item: MissionItem,
        /// Its altitude where the file states it by other means than its parameters.
        altitude: Option<Altitude>,
        /// Members that we do not know, as JSON text.
        members: BTreeMap<String, String>,
        /// Command as `QGroundControl` writes it.
        text: String,
    },
    /// Something that stands for several commands, such as a survey: its name, its text and they.
    Complex(String, String, Vec<MissionStep>),
    /// Something that is no command: its name and its text.
    Other(String, String),
}

/// The part of a command that a way-point cannot state.
#[derive(Deserialize)]
pub(super) struct CommandRemainder {
    pub command: u16,
    pub params: [Option<f64>; 4],
    #[serde(rename = "autoContinue")]
    pub is_continued: bool,
}

/// Command that follows a way-point and is none.
enum Between {
    Kept(String),
    Return(String),
    Speed(MissionItem, String),
}

/// Home of a mission: latitude and longitude in degrees, metres above mean sea level.
pub(super) type Home = [f64; 3];

/// The route that `steps` make, and notes on what is kept aside.
pub(super) fn route_of(steps: Vec<MissionStep>, home: Option<Home>) -> (ReadRoute, Vec<String>) {
    let has_jumps = steps
        .iter()
        .any(|s| matches!(s, MissionStep::Command { item, .. } if item.command == JUMP));
    let mut reader = ItemReader {
        has_jumps,
        ..ItemReader::default()
    };
    for step in steps {
        reader.step(step, home);
    }
    reader.finish(home)
}

#[derive(Default)]
struct ItemReader {
    route: ReadRoute,
    between: Vec<Between>,
    /// Texts of the items that stand for several commands, and their way-points.
    complex: Vec<(String, Vec<[f64; 4]>)>,
    /// Whether the commands are those of the last of them.
    is_inside: bool,
    shown: Vec<String>,
    has_jumps: bool,
    speed: Option<f64>,
    unknown: Vec<String>,
    simplified: Vec<String>,
    ground_speeds: usize,
    returns: usize,
    at_home: usize,
    homeless: usize,
    placeless: Vec<String>,
    incomplete: Vec<String>,
    same_altitudes: usize,
}

impl ItemReader {
    fn step(&mut self, step: MissionStep, home: Option<Home>) {
        match step {
            MissionStep::Other(name, text) => {
                self.unknown.push(name);
                self.between.push(Between::Kept(text));
            }
            MissionStep::Complex(name, text, steps) => {
                self.shown.push(name);
                self.complex.push((text, Vec::new()));
                self.is_inside = true;
                for step in steps {
                    self.step(step, home);
                }
                self.is_inside = false;
            }
            MissionStep::Command {
                item,
                altitude,
                mut members,
                text,
            } => {
                if !self.has_jumps {
                    members.remove("doJumpId");
                }
                self.command(item, altitude, &members, text, home);
            }
        }
    }

    fn command(
        &mut self,
        item: MissionItem,
        altitude: Option<Altitude>,
        members: &BTreeMap<String, String>,
        text: String,
        home: Option<Home>,
    ) {
        let own_text = |text: String| match self.complex.len() {
            count if self.is_inside => {
                format!("{{ \"complex\": {}, \"item\": {text} }}", count - 1)
            }
            _ => text,
        };
        let text = own_text(text);
        if is_plain_speed(&item) && !self.is_inside {
            self.between.push(Between::Speed(item, text));
            return;
        }
        let stated = altitude.or_else(|| item.altitude());
        let before = self.route.way_points.last().map(|(_, w)| w.altitude);
        let altitude = frame_of_number(item.frame).and_then(|_| stated.or(before));
        let place = Self::place(&item, home);
        let (Some(action), Some(altitude), Some(place)) = (item.action(), altitude, place) else {
            match item.command {
                // Of an item that stands for several commands the way-points are shown.
                _ if self.is_inside => {}
                RETURN_TO_LAUNCH => {
                    self.between.push(Between::Return(text));
                    return;
                }
                // Fences and rally points have notes of their own.
                command if is_fence(command) => {}
                _ if is_take_off(&item) && states_no_place(&item) => self.homeless += 1,
                command if item.action().is_some() && states_no_place(&item) => {
                    self.placeless.push(command_name(command));
                }
                command if item.action().is_some() && lacks_a_number(&item) => {
                    self.incomplete.push(command_name(command));
                }
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
        if stated.is_none() {
            self.same_altitudes += 1;
            let mark = "true".to_owned();
            way_point.properties.insert(SAME_ALTITUDE.to_owned(), mark);
        }
        if states_no_place(&item) {
            self.at_home += 1;
            let mark = "true".to_owned();
            way_point.properties.insert(AT_HOME.to_owned(), mark);
        }
        if action == WayPointAction::FlyBy && item.command != WAY_POINT && !self.is_inside {
            self.simplified.push(command_name(item.command));
        }
        self.settle(Some(&mut way_point));
        way_point.speed = self.speed;
        let number = self.complex.len().saturating_sub(1);
        if let Some((_, way_points)) = self.complex.last_mut().filter(|_| self.is_inside) {
            way_points.push(complex::stamp(place, &way_point));
            let number = number.to_string();
            way_point.properties.insert(COMPLEX.to_owned(), number);
        }
        self.route.way_points.push((place, way_point));
    }

    /// Place that the command leads to; a take-off that states no place is at home, if that is known.
    fn place(item: &MissionItem, home: Option<Home>) -> Option<LonLat> {
        item.action()?;
        if states_no_place(item) {
            let home = home.filter(|_| is_take_off(item));
            return home.map(|[latitude, longitude, _]| (longitude, latitude));
        }
        let [.., latitude, longitude, _] = item.parameters;
        let (latitude, longitude) = (latitude?, longitude?);
        on_globe(longitude, latitude).then_some((longitude, latitude))
    }

    /// Gives what stands between two way-points to the first of them, or to the route where there
    /// is none; `next` is the second.
    fn settle(&mut self, next: Option<&mut WayPoint>) {
        let between = std::mem::take(&mut self.between);
        let speed_before = self.speed;
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
        // What would be written here anyway is not kept, unless a jump may lead to it.
        let is_usual = speed_at.is_some_and(|at| {
            at + 1 == between.len()
                && !self.has_jumps
                && self.speed != speed_before
                && matches!(&between[at], Between::Speed(item, _) if is_usual_speed(item, self.speed))
        });
        let mut kept: Vec<String> = Vec::new();
        for (i, between) in between.into_iter().enumerate() {
            kept.push(match between {
                Between::Speed(_, text) if Some(i) == speed_at => {
                    format!("{{ \"{SPEED_MEMBER}\": {text} }}")
                }
                Between::Return(text) => {
                    self.returns += 1;
                    text
                }
                Between::Kept(text) | Between::Speed(_, text) => text,
            });
        }
        if is_usual {
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

    fn finish(mut self, home: Option<Home>) -> (ReadRoute, Vec<String>) {
        // Further back it may be reached by jumps alone.
        if !self.route.way_points.is_empty()
            && let Some(Between::Return(text)) = self
                .between
                .pop_if(|last| matches!(last, Between::Return(_)))
        {
            self.route.returns = true;
            self.route.properties.insert(RETURN.to_owned(), text);
        }
        self.settle(None);
        if let Some(home) = home {
            let home = Value::from(home.to_vec()).to_string();
            self.route.properties.insert(HOME.to_owned(), home);
        }
        let kept = self.complex.iter().filter_map(|(text, way_points)| {
            Some(Complex {
                item: serde_json::from_str(text).ok()?,
                way_points: way_points.clone(),
            })
        });
        // Texts and numbers always have a JSON form.
        if let (false, Ok(kept)) = (
            self.complex.is_empty(),
            serde_json::to_string(&kept.collect::<Vec<_>>()),
        ) {
            self.route.properties.insert(COMPLEX.to_owned(), kept);
        }
        let mut notes = Vec::new();
        if !self.shown.is_empty() {
            notes.push(format!(
                "shown are the way-points of what stands for several commands, and written again as it \
                 was unless they are changed: {}",
                counted(&self.shown)
            ));
        }
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
            notes.push(format!(
                "{} × return to launch before the end is kept, and not shown",
                self.returns
            ));
        }
        if self.at_home > 0 {
            notes.push("the take-off states no place: it is put at the home position".into());
        }
        if self.homeless > 0 {
            notes.push(
                "the take-off states no place, and the file no home: it is kept, and the route \
                 begins behind it"
                    .into(),
            );
        }
        if !self.placeless.is_empty() {
            notes.push(format!(
                "kept, and not shown, because no place is stated and the aircraft's own is meant: {}",
                counted(&self.placeless)
            ));
        }
        if !self.incomplete.is_empty() {
            notes.push(format!(
                "kept, and not shown, because a latitude, longitude or altitude is missing: {}",
                counted(&self.incomplete)
            ));
        }
        if self.same_altitudes > 0 {
            notes.push(format!(
                "{} × way-point states no altitude: that of the way-point before is taken",
                self.same_altitudes
            ));
        }
        if self.ground_speeds > 0 {
            notes.push(format!(
                "{} of the speeds are over ground; the prediction takes them for airspeeds",
                self.ground_speeds
            ));
        }
        if self.has_jumps {
            notes.push(
                "the mission jumps to commands by their numbers: check them after editing".into(),
            );
        }
        (self.route, notes)
    }
}

/// Whether no place is stated, by zeros or by nothing.
fn states_no_place(item: &MissionItem) -> bool {
    let [.., latitude, longitude, _] = item.parameters.map(|p| p.unwrap_or(0.0));
    (latitude, longitude) == (0.0, 0.0)
}

/// Whether one of the numbers of its place is missing.
fn lacks_a_number(item: &MissionItem) -> bool {
    item.parameters[4..].iter().any(Option::is_none)
}

fn is_take_off(item: &MissionItem) -> bool {
    item.action() == Some(WayPointAction::TakeOff)
}

/// Whether a command does nothing but change the speed to a number, or back to the usual one.
pub(super) fn is_plain_speed(item: &MissionItem) -> bool {
    let [kind, speed, rest @ ..] = &item.parameters;
    item.command == CHANGE_SPEED
        && matches!(kind, None | Some(0.0 | 1.0))
        && speed.is_some_and(|v| v > 0.0 || v == -2.0)
        && rest.iter().all(|p| matches!(p, None | Some(0.0 | -1.0)))
}
