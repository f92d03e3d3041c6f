//! Velocity over ground by satellite navigation.

use nalgebra::dvector;

use super::super::engine::MeasurementModel;
use super::aid::{AidInfo, AidNumber, BeginAid};
use super::direct::DirectAid;
use super::reading::APART;
use pilotage_flight::ChannelName;

/// Description for people.
pub const INFO: AidInfo = AidInfo {
    key: "gps-velocity",
    label: "GPS velocity",
    description: "How fast and which way the aircraft moves over ground, from the Doppler shift of the satellites' \
                  signals. An airplane that knows its airspeed and heading learns the wind from it.",
    channels: &[ChannelName::GpsVelocityNorth, ChannelName::GpsVelocityEast],
    components: &[("north", "m/s"), ("east", "m/s")],
    tells_place: false,
    numbers: &[
        AidNumber {
            key: "noise",
            label: "Error per axis",
            unit: "m/s",
            usual: 0.5,
        },
        APART,
    ],
};

/// Makes the aid.
// The error includes what the airspeed's reading errs at that moment.
pub const BEGIN: BeginAid = |numbers, _| {
    Ok(DirectAid::boxed(&INFO, numbers, |_| {
        MeasurementModel::of_motion(|seen| {
            let velocity = seen.velocity?;
            Some(dvector![velocity.x, velocity.y])
        })
    }))
};
