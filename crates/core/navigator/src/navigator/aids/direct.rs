//! Aids that read channels, each component with the same error.

use nalgebra::{DMatrix, DVector};

use super::super::engine::MeasurementModel;
use super::super::observation::Observation;
use super::aid::{Aid, AidInfo, AidMoment};
use super::assumed_air::AssumedAir;
use super::reading::AidReadings;

/// Measurement model of a reading.
type ReadingModel = fn(&DVector<f64>) -> MeasurementModel<'static>;

/// Covariance by which the expectation of a reading errs beside the reading itself; `None` where the reading tells nothing.
type ReadingDoubt = fn(&AssumedAir) -> Option<DMatrix<f64>>;

/// An aid whose numbers are the standard deviation of each component, in the components' unit, and the least time
/// between two readings, seconds.
pub struct DirectAid {
    info: &'static AidInfo,
    noise: f64,
    readings: AidReadings,
    model: ReadingModel,
    doubt: Option<ReadingDoubt>,
}

impl DirectAid {
    /// An aid with these numbers, in the order of its description.
    pub fn boxed(info: &'static AidInfo, numbers: &[f64], model: ReadingModel) -> Box<dyn Aid> {
        Box::new(Self::of(info, numbers, model))
    }

    /// The same of one whose expectation depends on how the vehicle moves through the air.
    pub fn through_air(
        info: &'static AidInfo,
        numbers: &[f64],
        model: ReadingModel,
        doubt: ReadingDoubt,
    ) -> Box<dyn Aid> {
        let doubt = Some(doubt);
        let aid = Self::of(info, numbers, model);
        Box::new(Self { doubt, ..aid })
    }

    fn of(info: &'static AidInfo, numbers: &[f64], model: ReadingModel) -> Self {
        Self {
            info,
            noise: numbers[0],
            readings: AidReadings::of(info, numbers[1]),
            model,
            doubt: None,
        }
    }

    fn reading(&mut self, moment: &AidMoment<'_>) -> Option<Observation<'static>> {
        let size = self.info.components.len();
        let mut noise = DMatrix::from_diagonal_element(size, size, self.noise.powi(2));
        if let Some(doubt) = self.doubt {
            noise += doubt(&moment.air)?;
        }
        let measured = self.readings.next(moment)?;
        Some(Observation {
            noise,
            weakened: None,
            model: (self.model)(&measured),
            measured,
            degrees: size,
            in_picture: None,
        })
    }
}

impl Aid for DirectAid {
    fn info(&self) -> &'static AidInfo {
        self.info
    }

    fn observe(&mut self, moment: &AidMoment<'_>) -> Vec<Observation<'static>> {
        self.reading(moment).into_iter().collect()
    }
}
