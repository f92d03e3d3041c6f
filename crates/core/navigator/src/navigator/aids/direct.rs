//! Aids that read channels, each component with the same error.

use nalgebra::{DMatrix, DVector};

use super::super::engine::MeasurementModel;
use super::super::observation::Observation;
use super::aid::{Aid, AidInfo, AidMoment};
use super::reading::AidReadings;

/// Measurement model of a reading.
type ReadingModel = fn(&DVector<f64>) -> MeasurementModel<'static>;

/// An aid whose numbers are the standard deviation of each component, in the components' unit, and the least time
/// between two readings, seconds.
pub struct DirectAid {
    info: &'static AidInfo,
    noise: f64,
    readings: AidReadings,
    model: ReadingModel,
}

impl DirectAid {
    /// An aid with these numbers, in the order of its description.
    pub fn boxed(info: &'static AidInfo, numbers: &[f64], model: ReadingModel) -> Box<dyn Aid> {
        Box::new(Self {
            info,
            noise: numbers[0],
            readings: AidReadings::of(info, numbers[1]),
            model,
        })
    }
}

impl Aid for DirectAid {
    fn info(&self) -> &'static AidInfo {
        self.info
    }

    fn observe(&mut self, moment: &AidMoment<'_>) -> Vec<Observation<'static>> {
        let size = self.info.components.len();
        let observation = |measured: DVector<f64>| Observation {
            noise: DMatrix::from_diagonal_element(size, size, self.noise.powi(2)),
            weakened: None,
            model: (self.model)(&measured),
            measured,
            degrees: size,
            in_picture: None,
        };
        let next = self.readings.next(moment);
        next.map(observation).into_iter().collect()
    }
}
