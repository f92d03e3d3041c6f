//! Distance to the ground by laser or radar.

use nalgebra::{DMatrix, dvector};

use super::super::engine::MeasurementModel;
use super::super::observation::Observation;
use super::aid::{Aid, AidInfo, AidMoment, AidNumber};
use super::reading::{APART, AidReadings};
use pilotage_flight::ChannelName;

/// Description for people.
pub const INFO: AidInfo = AidInfo {
    key: "ground-range",
    label: "Range to the ground",
    description: "How far a laser or radar that looks down sees the ground, which is taken to be level. The \
                  vehicle model has to estimate the height; with a barometer beside it, both are told apart.",
    channels: &[ChannelName::GroundRange],
    components: &[("range", "m")],
    numbers: &[
        AidNumber {
            key: "noise",
            label: "Error",
            unit: "m",
            usual: 0.5,
        },
        APART,
    ],
    begin: |numbers| {
        Box::new(GroundRange {
            noise: numbers[0],
            readings: AidReadings::of(&INFO, numbers[1]),
        })
    },
};

struct GroundRange {
    /// Standard deviation, metres.
    noise: f64,
    readings: AidReadings,
}

impl Aid for GroundRange {
    fn info(&self) -> &'static AidInfo {
        &INFO
    }

    fn observe(&mut self, moment: &AidMoment<'_>) -> Vec<Observation<'static>> {
        let observation = |measured| Observation {
            measured,
            noise: DMatrix::from_element(1, 1, self.noise.powi(2)),
            model: MeasurementModel::of_pose(|seen| {
                // Along the axis of a tilted body the ground is farther away.
                let down = seen.attitude.roll.cos() * seen.attitude.pitch.cos();
                (down > 0.1).then_some(())?;
                Some(dvector![seen.height? / down])
            }),
            degrees: 1,
        };
        self.readings
            .next(moment)
            .map(observation)
            .into_iter()
            .collect()
    }
}
