//! Heading by the earth's magnetic field.

use nalgebra::{DMatrix, DVector, dvector};

use super::super::engine::MeasurementModel;
use super::super::observation::Observation;
use super::aid::{Aid, AidInfo, AidMoment, AidNumber};
use super::reading::AidReadings;
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
    begin: |numbers| {
        Box::new(MagneticHeading {
            noise: numbers[0],
            readings: AidReadings::of(&INFO, numbers[1]),
        })
    },
};

struct MagneticHeading {
    /// Standard deviation, radians, with what the heading's own reading errs from one moment to the next.
    noise: f64,
    readings: AidReadings,
}

impl Aid for MagneticHeading {
    fn info(&self) -> &'static AidInfo {
        &INFO
    }

    fn observe(&mut self, moment: &AidMoment<'_>) -> Vec<Observation<'static>> {
        let observation = |measured: DVector<f64>| {
            let read = measured[0];
            Observation {
                measured,
                noise: DMatrix::from_element(1, 1, self.noise.powi(2)),
                model: MeasurementModel::of_pose(move |seen| {
                    seen.heading_bias?;
                    // Expectations near the reading differ from it by less than half a turn.
                    Some(dvector![read + wrap_pi(seen.attitude.yaw - read)])
                }),
                degrees: 1,
            }
        };
        self.readings
            .next(moment)
            .map(observation)
            .into_iter()
            .collect()
    }
}
