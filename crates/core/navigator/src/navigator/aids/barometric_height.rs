//! Height by air pressure.

use nalgebra::dvector;

use super::super::engine::MeasurementModel;
use super::aid::{AidInfo, AidNumber, BeginAid, NONE_PASSED_OVER};
use super::direct::DirectAid;
use super::reading::APART;
use pilotage_flight::ChannelName;

/// Description for people.
pub const INFO: AidInfo = AidInfo {
    key: "barometric-height",
    label: "Barometric height",
    description: "How high the air pressure says the aircraft is above whatever the barometer was set to. \
                  The vehicle model has to estimate the height, and does so with the barometer's bias.",
    channels: &[ChannelName::BarometricHeight],
    components: &[("height", "m")],
    tells_place: false,
    passes_over: NONE_PASSED_OVER,
    numbers: &[
        AidNumber {
            key: "noise",
            label: "Error",
            unit: "m",
            usual: 1.0,
        },
        APART,
    ],
};

/// Makes the aid.
pub const BEGIN: BeginAid = |numbers, _| {
    Ok(DirectAid::boxed(&INFO, numbers, |_| {
        MeasurementModel::of_pose(|seen| Some(dvector![seen.height? + seen.barometer_bias?]))
    }))
};
