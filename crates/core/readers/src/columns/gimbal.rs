//! Angles of a camera's gimbal in a table, as those of a camera that looks down.

use std::f64::consts::FRAC_PI_2;

use pilotage_base::frames::{Attitude, wrap_pi};
use pilotage_flight::{ChannelName, Flight};

use super::bodies::is_of_camera;
use super::{ColumnMap, ColumnRole};
use crate::gimbal::looking_down;

/// Difference of an offset from a quarter of a turn, radians, within which it is one.
const EQUAL: f64 = 1e-3;

/// Whether a map has a pitch and a roll of the camera, and adds a quarter of a turn to the pitch: they are those of a gimbal
/// that counts from the horizon, whose roll is about the view.
fn is_of_gimbal(map: &ColumnMap) -> bool {
    let of_camera = |name| {
        let column = map.column(ColumnRole::Channel(name));
        column.filter(|column| is_of_camera(column))
    };
    let pitch = of_camera(ChannelName::Pitch).and_then(|pitch| {
        let factor = pitch.role.factor(&pitch.unit)?;
        Some(pitch.offset * factor)
    });
    pitch.is_some_and(|offset| (offset - FRAC_PI_2).abs() < EQUAL)
        && of_camera(ChannelName::Roll).is_some()
}

/// Turns heading, roll and pitch of a flight, which its channels hold as the gimbal in a table tells them so far, a quarter
/// of a turn added to the pitch, to those of a camera that looks down ([`looking_down`]), at the times that have all of
/// them.
pub(super) fn turn(flight: &mut Flight, maps: &[ColumnMap]) {
    if !maps.iter().any(is_of_gimbal) {
        return;
    }
    let find = |name| flight.channels.iter().position(|c| c.name == name);
    let (Some(roll), Some(pitch)) = (find(ChannelName::Roll), find(ChannelName::Pitch)) else {
        return;
    };
    let heading = find(ChannelName::Heading);
    let at = |channel: usize, time: f64| {
        let channel = &flight.channels[channel];
        let index = channel.times.partition_point(|t| *t < time);
        let is_then = channel.times.get(index) == Some(&time);
        is_then.then(|| channel.values[index])
    };
    let turned = flight.channels[pitch].times.iter().filter_map(|&time| {
        let camera = looking_down(Attitude {
            roll: at(roll, time)?,
            pitch: at(pitch, time)? - FRAC_PI_2,
            yaw: heading.map_or(Some(0.0), |heading| at(heading, time))?,
        });
        Some((time, camera))
    });
    let turned: Vec<(f64, Attitude)> = turned.collect();
    if turned.is_empty() {
        return;
    }
    let mut write = |channel: usize, part: fn(&Attitude) -> f64| {
        let channel = &mut flight.channels[channel];
        (channel.times, channel.values) = turned.iter().map(|(t, it)| (*t, part(it))).unzip();
    };
    write(roll, |camera| camera.roll);
    write(pitch, |camera| camera.pitch);
    if let Some(heading) = heading {
        write(heading, |camera| wrap_pi(camera.yaw));
    }
}
