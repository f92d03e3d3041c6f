//! Position by satellite navigation.

use nalgebra::dvector;

use super::super::engine::MeasurementModel;
use super::aid::{AidInfo, AidNumber, BeginAid, NONE_PASSED_OVER};
use super::direct::DirectAid;
use super::reading::APART;
use pilotage_flight::ChannelName;

/// Description for people.
pub const INFO: AidInfo = AidInfo {
    key: "gps-position",
    label: "GPS position",
    description: "Where satellite navigation says the aircraft is. Its error lasts for seconds, so that readings \
                  near each other tell the same thing again.",
    channels: &[ChannelName::GpsNorth, ChannelName::GpsEast],
    components: &[("north", "m"), ("east", "m")],
    tells_place: true,
    passes_over: NONE_PASSED_OVER,
    numbers: &[
        AidNumber {
            key: "noise",
            label: "Error per axis",
            unit: "m",
            usual: 2.5,
        },
        APART,
    ],
};

/// Makes the aid.
pub const BEGIN: BeginAid = |numbers, _| {
    Ok(DirectAid::boxed(&INFO, numbers, |_| {
        MeasurementModel::of_pose(|seen| Some(dvector![seen.position.north, seen.position.east]))
    }))
};
