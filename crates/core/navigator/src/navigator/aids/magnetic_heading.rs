//! Heading by the earth's magnetic field.

use nalgebra::{DMatrix, DVector, dvector};

use super::super::engine::MeasurementModel;
use super::aid::{AidInfo, AidNumber, BeginAid, NONE_PASSED_OVER};
use super::direct::DirectAid;
use pilotage_base::frames::wrap_pi;
use pilotage_flight::ChannelName;

/// Description for people.
pub const INFO: AidInfo = AidInfo {
    key: "magnetic-heading",
    label: "Magnetic heading",
    description: "Where a compass says the nose points. Iron and currents aboard turn it another way on every heading, \
                  so that only readings far apart err by themselves. It tells the bias of the heading to a vehicle \
                  model that has one.",
    channels: &[ChannelName::MagneticHeading],
    components: &[("heading", "rad")],
    tells_place: false,
    passes_over: NONE_PASSED_OVER,
    numbers: &[
        AidNumber {
            key: "noise",
            label: "Error",
            unit: "rad",
            usual: 0.05,
        },
        AidNumber {
            key: "apart",
            label: "Time between readings",
            unit: "s",
            usual: 20.0,
        },
    ],
};

/// Makes the aid.
// The error includes what the heading's own reading errs from one moment to the next.
pub const BEGIN: BeginAid = |numbers, _| {
    let model = |measured: &DVector<f64>| {
        let read = measured[0];
        MeasurementModel::of_pose(move |seen| {
            seen.heading_bias?;
            // Expectations near the reading differ from it by less than half a turn.
            Some(dvector![read + wrap_pi(seen.attitude.yaw - read)])
        })
    };
    // A heading that is held from earlier has no bias that could be told.
    Ok(DirectAid::through_air(&INFO, numbers, model, |air| {
        (!air.holds_heading).then(|| DMatrix::zeros(1, 1))
    }))
};
