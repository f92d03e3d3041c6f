//! Properties of one way-point beside its place in a file, as a JSON object.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde_json::Value;

use super::text::{ObjectMembers, Text};
use super::{MissionError, WayPoint, WayPointAction};
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};

/// Altitude of way-points where a file states none.
pub const USUAL_ALTITUDE: Altitude = Altitude::new(100.0, AltitudeFrame::AboveTakeOff);

/// Word of a file for what an altitude counts from.
pub(crate) fn frame_word(frame: AltitudeFrame) -> &'static str {
    match frame {
        AltitudeFrame::Amsl => "amsl",
        AltitudeFrame::AboveTakeOff => "above_take_off",
        AltitudeFrame::AboveGround => "above_ground",
    }
}

/// Reference that an altitude counts from, by its word in a file.
pub(crate) fn frame_of_word(word: &str) -> Option<AltitudeFrame> {
    AltitudeFrame::ALL
        .into_iter()
        .find(|frame| frame_word(*frame) == word)
}

/// Word of a file for what is done at a way-point.
pub(crate) fn action_word(action: &WayPointAction) -> &'static str {
    match action {
        WayPointAction::FlyBy => "fly_by",
        WayPointAction::Loiter { .. } => "loiter",
        WayPointAction::TakeOff => "take_off",
        WayPointAction::Land => "land",
        WayPointAction::Wait { .. } => "wait",
    }
}

/// Words of a file for actions, for people.
pub(crate) const ACTION_WORDS: &str = "fly_by, loiter, wait, take_off and land";

/// Circles at a way-point as a file states them.
#[derive(Clone, Copy, Default)]
pub(crate) struct StatedCircles {
    /// Radius, metres; negative for circles to the left.
    pub radius: Option<f64>,
    /// Number of circles.
    pub turns: Option<f64>,
    /// Seconds.
    pub seconds: Option<f64>,
}

impl StatedCircles {
    /// Circles of an action.
    pub(crate) fn of(action: &WayPointAction) -> Self {
        match *action {
            WayPointAction::Loiter { radius, turns } => Self {
                radius: Some(radius),
                turns: Some(turns),
                seconds: None,
            },
            WayPointAction::Wait { radius, seconds } => Self {
                radius: Some(radius),
                turns: None,
                seconds,
            },
            _ => Self::default(),
        }
    }
}

/// Action at a way-point, by its word in a file and the circles that go with it.
pub(crate) fn action_of_word(word: &str, circles: &StatedCircles) -> Option<WayPointAction> {
    let radius = circles.radius.unwrap_or(0.0);
    [
        WayPointAction::FlyBy,
        WayPointAction::Loiter {
            radius,
            turns: circles.turns.unwrap_or(1.0),
        },
        WayPointAction::TakeOff,
        WayPointAction::Land,
        WayPointAction::Wait {
            radius,
            seconds: circles.seconds,
        },
    ]
    .into_iter()
    .find(|action| action_word(action) == word)
}

/// The object that states everything about a way-point but its place.
pub(crate) fn write_way_point(way_point: &WayPoint) -> String {
    let mut text = format!("{{ {}", altitude_members(&way_point.altitude));
    // Writing into a string cannot fail.
    if let Some(speed) = way_point.speed {
        let _ = write!(text, ", \"speed_mps\": {}", Value::from(speed));
    }
    if way_point.action != WayPointAction::FlyBy {
        let _ = write!(text, ", \"action\": \"{}\"", action_word(&way_point.action));
    }
    let StatedCircles {
        radius,
        turns,
        seconds,
    } = StatedCircles::of(&way_point.action);
    for (name, value) in [("radius_m", radius), ("turns", turns), ("seconds", seconds)] {
        if let Some(value) = value {
            let _ = write!(text, ", \"{name}\": {}", Value::from(value));
        }
    }
    for (name, value) in &way_point.properties {
        let _ = write!(text, ", {}: {value}", Value::from(name.as_str()));
    }
    text.push_str(" }");
    text
}

/// The way-point that such an object, a piece of `text`, states; its place is not known yet.
pub(crate) fn read_way_point<'a>(
    text: &Text<'a>,
    piece: &'a str,
) -> Result<WayPoint, MissionError> {
    let mut members: ObjectMembers = text.members(piece)?;
    let altitude = read_altitude(text, piece, &mut members)?;
    let speed = text.take(&mut members, "speed_mps")?;
    let action_place = members.get("action").map_or(piece, |value| value.get());
    let action = match text.take::<String>(&mut members, "action")? {
        None => WayPointAction::FlyBy,
        Some(word) => {
            // What the action does not state is somebody else's, and kept.
            let mut number = |of: &[&str], name: &str| {
                let is_own = of.contains(&word.as_str());
                is_own
                    .then(|| text.take::<f64>(&mut members, name))
                    .transpose()
            };
            let circles = StatedCircles {
                radius: number(&["loiter", "wait"], "radius_m")?.flatten(),
                turns: number(&["loiter"], "turns")?.flatten(),
                seconds: number(&["wait"], "seconds")?.flatten(),
            };
            action_of_word(&word, &circles).ok_or_else(|| {
                text.error(action_place, format!("`{word}` is none of {ACTION_WORDS}"))
            })?
        }
    };
    Ok(WayPoint {
        position: GroundPoint::default(),
        altitude,
        speed,
        action,
        properties: kept(members),
    })
}

/// Takes out the altitude that the object `piece` of `text` states; the usual one where it states none.
pub(super) fn read_altitude<'a>(
    text: &Text<'a>,
    piece: &'a str,
    members: &mut ObjectMembers<'a>,
) -> Result<Altitude, MissionError> {
    let place = members
        .get("altitude_frame")
        .map_or(piece, |value| value.get());
    let frame = match text.take::<String>(members, "altitude_frame")? {
        None => USUAL_ALTITUDE.frame,
        Some(word) => frame_of_word(&word).ok_or_else(|| {
            text.error(
                place,
                format!("`{word}` is none of amsl, above_take_off and above_ground"),
            )
        })?,
    };
    let metres = text.take(members, "altitude_m")?;
    Ok(Altitude::new(
        metres.unwrap_or(USUAL_ALTITUDE.metres),
        frame,
    ))
}

/// The members that state an altitude.
pub(super) fn altitude_members(altitude: &Altitude) -> String {
    format!(
        "\"altitude_m\": {}, \"altitude_frame\": \"{}\"",
        Value::from(altitude.metres),
        frame_word(altitude.frame)
    )
}

/// Members that we do not know, as JSON text.
pub(crate) fn kept(members: ObjectMembers) -> BTreeMap<String, String> {
    members
        .into_iter()
        .map(|(name, value)| (name, value.get().to_owned()))
        .collect()
}
