//! Distance to the ground by laser or radar.

use nalgebra::dvector;

use super::super::engine::MeasurementModel;
use super::aid::{AidInfo, AidNumber, BeginAid, NONE_PASSED_OVER};
use super::direct::DirectAid;
use super::reading::APART;
use pilotage_flight::ChannelName;

/// Description for people.
pub const INFO: AidInfo = AidInfo {
    key: "ground-range",
    label: "Range to the ground",
    description: "How far a laser or radar that looks down sees the ground, which is taken to be level. The \
                  vehicle model has to estimate the height; with a barometer beside it, both are told apart.",
    channels: &[ChannelName::GroundRange],
    components: &[("range", "m")],
    tells_place: false,
    passes_over: NONE_PASSED_OVER,
    numbers: &[
        AidNumber {
            key: "noise",
            label: "Error",
            unit: "m",
            usual: 0.5,
        },
        APART,
    ],
};

/// Makes the aid.
pub const BEGIN: BeginAid = |numbers, _| {
    Ok(DirectAid::boxed(&INFO, numbers, |_| {
        MeasurementModel::of_pose(|seen| {
            // Along the axis of a tilted body the ground is farther away.
            let down = seen.attitude.roll.cos() * seen.attitude.pitch.cos();
            (down > 0.1).then_some(())?;
            Some(dvector![seen.height? / down])
        })
    }))
};
