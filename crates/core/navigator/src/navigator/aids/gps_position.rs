//! Position by satellite navigation.

use nalgebra::{DMatrix, dvector};

use super::super::engine::MeasurementModel;
use super::super::observation::Observation;
use super::aid::{Aid, AidInfo, AidMoment, AidNumber};
use super::reading::{APART, AidReadings};
use pilotage_flight::ChannelName;

/// Description for people.
pub const INFO: AidInfo = AidInfo {
    key: "gps-position",
    label: "GPS position",
    description: "Where satellite navigation says the aircraft is. Its error lasts for seconds, so that readings \
                  near each other tell the same thing again.",
    channels: &[ChannelName::GpsNorth, ChannelName::GpsEast],
    components: &[("north", "m"), ("east", "m")],
    numbers: &[
        AidNumber {
            key: "noise",
            label: "Error per axis",
            unit: "m",
            usual: 2.5,
        },
        APART,
    ],
    begin: |numbers| {
        Box::new(GpsPosition {
            noise: numbers[0],
            readings: AidReadings::of(&INFO, numbers[1]),
        })
    },
};

struct GpsPosition {
    /// Standard deviation per axis, metres.
    noise: f64,
    readings: AidReadings,
}

impl Aid for GpsPosition {
    fn info(&self) -> &'static AidInfo {
        &INFO
    }

    fn observe(&mut self, moment: &AidMoment<'_>) -> Vec<Observation<'static>> {
        let observation = |measured| Observation {
            measured,
            noise: DMatrix::from_diagonal_element(2, 2, self.noise.powi(2)),
            model: MeasurementModel::of_pose(|seen| {
                Some(dvector![seen.position.north, seen.position.east])
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
