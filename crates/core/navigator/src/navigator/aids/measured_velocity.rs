//! Velocity over ground by other means than satellites.

use nalgebra::{DMatrix, dvector};

use super::super::engine::MeasurementModel;
use super::super::observation::Observation;
use super::aid::{Aid, AidInfo, AidMoment, AidNumber};
use super::reading::{APART, AidReadings};
use pilotage_flight::ChannelName;

/// Description for people.
pub const INFO: AidInfo = AidInfo {
    key: "measured-velocity",
    label: "Measured velocity",
    description: "How fast and which way the aircraft moves over ground, by motion capture or optical flow.",
    channels: &[ChannelName::VelocityNorth, ChannelName::VelocityEast],
    components: &[("north", "m/s"), ("east", "m/s")],
    numbers: &[
        AidNumber {
            key: "noise",
            label: "Error per axis",
            unit: "m/s",
            usual: 0.3,
        },
        APART,
    ],
    begin: |numbers| {
        Box::new(MeasuredVelocity {
            noise: numbers[0],
            readings: AidReadings::of(&INFO, numbers[1]),
        })
    },
};

struct MeasuredVelocity {
    /// Standard deviation per axis, m/s.
    noise: f64,
    readings: AidReadings,
}

impl Aid for MeasuredVelocity {
    fn info(&self) -> &'static AidInfo {
        &INFO
    }

    fn observe(&mut self, moment: &AidMoment<'_>) -> Vec<Observation<'static>> {
        let observation = |measured| Observation {
            measured,
            noise: DMatrix::from_diagonal_element(2, 2, self.noise.powi(2)),
            model: MeasurementModel::of_motion(|seen| {
                let velocity = seen.velocity?;
                Some(dvector![velocity.x, velocity.y])
            }),
            degrees: 2,
        };
        self.readings
            .next(moment)
            .map(observation)
            .into_iter()
            .collect()
    }
}
