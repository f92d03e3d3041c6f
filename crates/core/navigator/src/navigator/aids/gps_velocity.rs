//! Velocity over ground by satellite navigation.

use nalgebra::{DMatrix, dvector};

use super::super::engine::MeasurementModel;
use super::super::observation::Observation;
use super::aid::{Aid, AidInfo, AidMoment, AidNumber};
use super::reading::{APART, AidReadings};
use pilotage_flight::ChannelName;

/// Description for people.
pub const INFO: AidInfo = AidInfo {
    key: "gps-velocity",
    label: "GPS velocity",
    description: "How fast and which way the aircraft moves over ground, from the Doppler shift of the satellites' \
                  signals. An airplane that knows its airspeed and heading learns the wind from it.",
    channels: &[ChannelName::GpsVelocityNorth, ChannelName::GpsVelocityEast],
    components: &[("north", "m/s"), ("east", "m/s")],
    numbers: &[
        AidNumber {
            key: "noise",
            label: "Error per axis",
            unit: "m/s",
            usual: 0.5,
        },
        APART,
    ],
    begin: |numbers| {
        Box::new(GpsVelocity {
            noise: numbers[0],
            readings: AidReadings::of(&INFO, numbers[1]),
        })
    },
};

struct GpsVelocity {
    /// Standard deviation per axis, m/s, with what the airspeed's reading errs at that moment.
    noise: f64,
    readings: AidReadings,
}

impl Aid for GpsVelocity {
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
