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
    }
}

/// Action at a way-point, by its word in a file and the circle that goes with loitering.
pub(crate) fn action_of_word(word: &str, radius: f64, turns: f64) -> Option<WayPointAction> {
    [
        WayPointAction::FlyBy,
        WayPointAction::Loiter { radius, turns },
        WayPointAction::TakeOff,
        WayPointAction::Land,
    ]
    .into_iter()
    .find(|action| action_word(action) == word)
}

/// The object that states everything about a way-point but its place.
pub(crate) fn write_way_point(way_point: &WayPoint) -> String {
    let altitude = &way_point.altitude;
    // Writing into a string cannot fail.
    let mut text = format!(
        "{{ \"altitude_m\": {}, \"altitude_frame\": \"{}\"",
        Value::from(altitude.metres),
        frame_word(altitude.frame)
    );
    if let Some(speed) = way_point.speed {
        let _ = write!(text, ", \"speed_mps\": {}", Value::from(speed));
    }
    if way_point.action != WayPointAction::FlyBy {
        let _ = write!(text, ", \"action\": \"{}\"", action_word(&way_point.action));
    }
    if let WayPointAction::Loiter { radius, turns } = way_point.action {
        let _ = write!(
            text,
            ", \"radius_m\": {}, \"turns\": {}",
            Value::from(radius),
            Value::from(turns)
        );
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
    let place = |members: &ObjectMembers<'a>, name: &str| {
        members.get(name).map_or(piece, |value| value.get())
    };
    let frame_place = place(&members, "altitude_frame");
    let frame = match text.take::<String>(&mut members, "altitude_frame")? {
        None => USUAL_ALTITUDE.frame,
        Some(word) => frame_of_word(&word).ok_or_else(|| {
            text.error(
                frame_place,
                format!("`{word}` is none of amsl, above_take_off and above_ground"),
            )
        })?,
    };
    let metres = text
        .take(&mut members, "altitude_m")?
        .unwrap_or(USUAL_ALTITUDE.metres);
    let speed = text.take(&mut members, "speed_mps")?;
    let action_place = place(&members, "action");
    let action = match text.take::<String>(&mut members, "action")? {
        None => WayPointAction::FlyBy,
        Some(word) => {
            let (radius, turns) = if word == "loiter" {
                (
                    text.take(&mut members, "radius_m")?.unwrap_or(0.0),
                    text.take(&mut members, "turns")?.unwrap_or(1.0),
                )
            } else {
                (0.0, 0.0)
            };
            action_of_word(&word, radius, turns).ok_or_else(|| {
                text.error(
                    action_place,
                    format!("`{word}` is none of fly_by, loiter, take_off and land"),
                )
            })?
        }
    };
    Ok(WayPoint {
        position: GroundPoint::default(),
        altitude: Altitude::new(metres, frame),
        speed,
        action,
        properties: kept(members),
    })
}

/// Members that we do not know, as JSON text.
pub(crate) fn kept(members: ObjectMembers) -> BTreeMap<String, String> {
    members
        .into_iter()
        .map(|(name, value)| (name, value.get().to_owned()))
        .collect()
}
