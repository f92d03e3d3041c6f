//! Commands of a mission as `MAVLink` numbers them, whatever file they stand in.

use std::fmt::Write;

use serde::Deserialize;
use serde_json::Value;

use crate::mission::WayPointAction;
use crate::mission::found::on_globe;
use pilotage_base::frames::{Altitude, AltitudeFrame};

pub(super) const WAY_POINT: u16 = 16;
pub(super) const LOITER_UNLIMITED: u16 = 17;
pub(super) const LOITER_TURNS: u16 = 18;
pub(super) const LOITER_TIME: u16 = 19;
pub(super) const RETURN_TO_LAUNCH: u16 = 20;
pub(super) const LAND: u16 = 21;
pub(super) const TAKE_OFF: u16 = 22;
pub(super) const LOITER_TO_ALTITUDE: u16 = 31;
const ARC_WAY_POINT: u16 = 36;
const SPLINE_WAY_POINT: u16 = 82;
const VTOL_TAKE_OFF: u16 = 84;
pub(super) const VTOL_LAND: u16 = 85;
pub(super) const LAND_START: u16 = 189;
pub(super) const JUMP: u16 = 177;
pub(super) const CHANGE_SPEED: u16 = 178;

/// Names of commands that are met often, for notes.
const NAMES: [(u16, &str); 33] = [
    (LOITER_UNLIMITED, "LOITER_UNLIM"),
    (LOITER_TURNS, "LOITER_TURNS"),
    (LOITER_TIME, "LOITER_TIME"),
    (RETURN_TO_LAUNCH, "RETURN_TO_LAUNCH"),
    (LAND, "LAND"),
    (TAKE_OFF, "TAKEOFF"),
    (30, "CONTINUE_AND_CHANGE_ALT"),
    (LOITER_TO_ALTITUDE, "LOITER_TO_ALT"),
    (ARC_WAY_POINT, "ARC_WAYPOINT"),
    (SPLINE_WAY_POINT, "SPLINE_WAYPOINT"),
    (VTOL_TAKE_OFF, "VTOL_TAKEOFF"),
    (VTOL_LAND, "VTOL_LAND"),
    (93, "DELAY"),
    (112, "CONDITION_DELAY"),
    (115, "CONDITION_YAW"),
    (JUMP, "DO_JUMP"),
    (CHANGE_SPEED, "DO_CHANGE_SPEED"),
    (183, "DO_SET_SERVO"),
    (LAND_START, "DO_LAND_START"),
    (195, "DO_SET_ROI_LOCATION"),
    (201, "DO_SET_ROI"),
    (203, "DO_DIGICAM_CONTROL"),
    (205, "DO_MOUNT_CONTROL"),
    (206, "DO_SET_CAM_TRIGG_DIST"),
    (600, "JUMP_TAG"),
    (601, "DO_JUMP_TAG"),
    (2000, "IMAGE_START_CAPTURE"),
    (5000, "FENCE_RETURN_POINT"),
    (5001, "FENCE_POLYGON_VERTEX_INCLUSION"),
    (5002, "FENCE_POLYGON_VERTEX_EXCLUSION"),
    (5003, "FENCE_CIRCLE_INCLUSION"),
    (5004, "FENCE_CIRCLE_EXCLUSION"),
    (5100, "RALLY_POINT"),
];

/// A command with its parameters, the last three of which are latitude, longitude and altitude.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MissionItem {
    /// `MAV_CMD`.
    pub command: u16,
    /// `MAV_FRAME`.
    pub frame: u8,
    /// Parameters one to seven; `None` is `MAVLink`'s NaN, "leave it as it is".
    pub parameters: [Option<f64>; 7],
    /// Whether the next command follows by itself.
    pub is_continued: bool,
}

impl MissionItem {
    /// Members of the object by which `QGroundControl` states it.
    pub(super) fn json(&self, jump_id: usize) -> String {
        let parameters: Vec<String> = self
            .parameters
            .iter()
            .map(|p| Value::from(p.unwrap_or(f64::NAN)).to_string())
            .collect();
        format!(
            "{{ \"autoContinue\": {}, \"command\": {}, \"doJumpId\": {jump_id}, \"frame\": {}, \
             \"params\": [{}], \"type\": \"SimpleItem\" }}",
            self.is_continued,
            self.command,
            self.frame,
            parameters.join(", ")
        )
    }

    /// The command that `QGroundControl` states by this text, or else the name of what that is.
    pub(super) fn of_json(text: &str) -> Result<Self, String> {
        #[derive(Deserialize)]
        #[serde(rename_all = "camelCase")]
        struct Simple {
            r#type: String,
            complex_item_type: Option<String>,
            command: Option<u16>,
            frame: Option<u8>,
            params: Option<[Option<f64>; 7]>,
            auto_continue: Option<bool>,
        }
        let simple: Simple = serde_json::from_str(text).map_err(|_| "an unknown item")?;
        match (simple.command, simple.frame, simple.params) {
            (Some(command), Some(frame), Some(parameters)) => Ok(Self {
                command,
                frame,
                parameters,
                is_continued: simple.auto_continue.unwrap_or(true),
            }),
            _ => Err(simple.complex_item_type.unwrap_or(simple.r#type)),
        }
    }

    /// The altitude, as parameter and frame state it; `None` where it is in no global frame, or is not stated and not that of
    /// the ground where the aircraft lands.
    pub(super) fn altitude(&self) -> Option<Altitude> {
        let frame = frame_of_number(self.frame)?;
        let is_landing = self.action() == Some(WayPointAction::Land);
        let metres = self.parameters[6].or(is_landing.then_some(0.0))?;
        Some(Altitude::new(metres, frame))
    }

    /// Index of the parameter that is no latitude or no longitude, though the command leads to a place on the globe, and what
    /// is wrong with it.
    pub(super) fn place_fault(&self) -> Option<(usize, String)> {
        self.action().and(frame_of_number(self.frame))?;
        let [.., latitude, longitude, _] = self.parameters;
        let (index, beyond, name) = match (latitude, longitude) {
            (Some(latitude), _) if !on_globe(0.0, latitude) => (4, latitude, "latitude"),
            (_, Some(longitude)) if !on_globe(longitude, 0.0) => (5, longitude, "longitude"),
            _ => return None,
        };
        Some((index, format!("{beyond} is no {name} in degrees")))
    }

    /// Action at the place of the command; `None` if it leads to no place.
    pub(super) fn action(&self) -> Option<WayPointAction> {
        Some(match self.command {
            // A way-point at which rotorcraft stay for a time.
            WAY_POINT if self.parameters[0].is_some_and(|seconds| seconds > 0.0) => {
                WayPointAction::Wait {
                    radius: 0.0,
                    seconds: self.parameters[0],
                }
            }
            WAY_POINT | LOITER_TO_ALTITUDE | ARC_WAY_POINT | SPLINE_WAY_POINT => {
                WayPointAction::FlyBy
            }
            LOITER_UNLIMITED => WayPointAction::Wait {
                radius: self.parameters[2].unwrap_or(0.0),
                seconds: None,
            },
            LOITER_TIME => WayPointAction::Wait {
                radius: self.parameters[2].unwrap_or(0.0),
                seconds: Some(self.parameters[0].unwrap_or(0.0)),
            },
            LOITER_TURNS => WayPointAction::Loiter {
                turns: self.parameters[0].unwrap_or(1.0),
                radius: self.parameters[2].unwrap_or(0.0),
            },
            TAKE_OFF | VTOL_TAKE_OFF => WayPointAction::TakeOff,
            LAND | VTOL_LAND => WayPointAction::Land,
            _ => return None,
        })
    }
}

/// The command that stands for an action, and its parameters one to four.
pub(super) fn command_of(action: &WayPointAction) -> (u16, [Option<f64>; 4]) {
    let plain = [Some(0.0), Some(0.0), Some(0.0), None];
    // The fourth says where the circle is left; ArduPilot takes nothing but a number. Of a circle without an end it is a
    // heading, to which PX4 turns multicopters.
    let circling = |first, radius| [first, 0.0, radius, 0.0].map(Some);
    match *action {
        WayPointAction::FlyBy => (WAY_POINT, plain),
        WayPointAction::Loiter { radius, turns } => (LOITER_TURNS, circling(turns, radius)),
        WayPointAction::TakeOff => (TAKE_OFF, plain),
        WayPointAction::Land => (LAND, plain),
        WayPointAction::Wait {
            radius,
            seconds: Some(seconds),
        } => (LOITER_TIME, circling(seconds, radius)),
        WayPointAction::Wait {
            radius,
            seconds: None,
        } => (LOITER_UNLIMITED, [Some(0.0), Some(0.0), Some(radius), None]),
    }
}

/// Whether the fourth parameter of a command is a heading that may be left to the aircraft, which is no number then.
pub(super) fn may_leave_heading(command: u16) -> bool {
    [
        WAY_POINT,
        LOITER_UNLIMITED,
        LAND,
        TAKE_OFF,
        VTOL_TAKE_OFF,
        VTOL_LAND,
    ]
    .contains(&command)
}

/// The return to launch.
pub(super) fn return_to_launch() -> MissionItem {
    MissionItem {
        command: RETURN_TO_LAUNCH,
        frame: 2,
        parameters: [Some(0.0); 7],
        is_continued: true,
    }
}

/// Meaning of a number of `MAV_FRAME`: what altitudes in it count from; `None` for frames that are not global.
pub(super) fn frame_of_number(number: u8) -> Option<AltitudeFrame> {
    match number {
        0 | 5 => Some(AltitudeFrame::Amsl),
        3 | 6 => Some(AltitudeFrame::AboveTakeOff),
        10 | 11 => Some(AltitudeFrame::AboveGround),
        _ => None,
    }
}

/// Number of `MAVLink` for what an altitude counts from.
pub(super) fn frame_number(frame: AltitudeFrame) -> u8 {
    match frame {
        AltitudeFrame::Amsl => 0,
        AltitudeFrame::AboveTakeOff => 3,
        AltitudeFrame::AboveGround => 10,
    }
}

/// Name of a command, for notes.
pub(super) fn command_name(command: u16) -> String {
    NAMES
        .iter()
        .find(|(number, _)| *number == command)
        .map_or_else(
            || format!("command {command}"),
            |(_, name)| (*name).to_owned(),
        )
}

/// Count of each name, for notes: `2 × DELAY, survey`.
pub(super) fn counted(names: &[String]) -> String {
    let mut text = String::new();
    for (i, name) in names.iter().enumerate() {
        if names[..i].contains(name) {
            continue;
        }
        let separator = if text.is_empty() { "" } else { ", " };
        let count = names.iter().filter(|n| *n == name).count();
        // Writing into a string cannot fail.
        let _ = match count {
            1 => write!(text, "{separator}{name}"),
            _ => write!(text, "{separator}{count} × {name}"),
        };
    }
    text
}
