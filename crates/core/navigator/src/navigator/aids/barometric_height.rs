//! Height by air pressure.

use nalgebra::{DMatrix, dvector};

use super::super::engine::MeasurementModel;
use super::super::observation::Observation;
use super::aid::{Aid, AidInfo, AidMoment, AidNumber};
use super::reading::{APART, AidReadings};
use pilotage_flight::ChannelName;

/// Description for people.
pub const INFO: AidInfo = AidInfo {
    key: "barometric-height",
    label: "Barometric height",
    description: "How high the air pressure says the aircraft is above whatever the barometer was set to. \
                  The vehicle model has to estimate the height, and does so with the barometer's bias.",
    channels: &[ChannelName::BarometricHeight],
    components: &[("height", "m")],
    numbers: &[
        AidNumber {
            key: "noise",
            label: "Error",
            unit: "m",
            usual: 1.0,
        },
        APART,
    ],
    begin: |numbers| {
        Box::new(BarometricHeight {
            noise: numbers[0],
            readings: AidReadings::of(&INFO, numbers[1]),
        })
    },
};

struct BarometricHeight {
    /// Standard deviation, metres.
    noise: f64,
    readings: AidReadings,
}

impl Aid for BarometricHeight {
    fn info(&self) -> &'static AidInfo {
        &INFO
    }

    fn observe(&mut self, moment: &AidMoment<'_>) -> Vec<Observation<'static>> {
        let observation = |measured| Observation {
            measured,
            noise: DMatrix::from_element(1, 1, self.noise.powi(2)),
            model: MeasurementModel::of_pose(|seen| {
                Some(dvector![seen.height? + seen.barometer_bias?])
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
