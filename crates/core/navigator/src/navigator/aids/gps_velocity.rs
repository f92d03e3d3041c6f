//! Velocity over ground by satellite navigation.

use nalgebra::{DMatrix, DVector, dvector};

use super::super::engine::MeasurementModel;
use super::aid::{AidInfo, AidNumber, BeginAid, NONE_PASSED_OVER};
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
    passes_over: NONE_PASSED_OVER,
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
// The error includes what the airspeed's reading errs at that moment; where there is none, that of what is assumed is added.
pub const BEGIN: BeginAid = |numbers, _| {
    let model = |_: &DVector<f64>| {
        MeasurementModel::of_motion(|seen| {
            let velocity = seen.velocity?;
            Some(dvector![velocity.x, velocity.y])
        })
    };
    Ok(DirectAid::through_air(&INFO, numbers, model, |air| {
        let velocity = air.velocity;
        Some(DMatrix::from_column_slice(2, 2, velocity.as_slice()))
    }))
};
