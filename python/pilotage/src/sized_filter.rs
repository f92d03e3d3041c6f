//! The filter of whatever number of components, which is fixed where it is compiled.

use std::any::Any;

use nalgebra::{DMatrix, DVector, Dyn, SMatrix, SVector};
use pilotage_core::filter::{FilterError, Gate, Gaussian, Ukf, UnscentedSettings};

/// Most components of a state.
pub const MOST: usize = 12;

/// Mean, and covariance or points column by column.
#[derive(Clone, Debug)]
pub struct Belief {
    /// Mean.
    pub mean: Vec<f64>,
    /// Covariance; symmetric, so that columns are rows.
    pub covariance: Vec<f64>,
}

/// A correction as it was done, or what it would have been.
pub struct CorrectionOfFilter {
    /// Measurement minus expectation, m.
    pub innovation: Vec<f64>,
    /// Innovation covariance, m × m.
    pub innovation_covariance: Vec<f64>,
    /// Gain, n × m, row by row; none where the gate refused it.
    pub gain: Option<Vec<f64>>,
    /// Normalized innovation squared.
    pub nis: f64,
    /// Largest one that the gate lets through.
    pub limit: f64,
}

/// A measurement with its model.
pub struct Measured<'a> {
    /// Measured values, m.
    pub values: &'a [f64],
    /// Model: expected values for a state.
    pub model: &'a dyn Fn(&[f64]) -> Option<Vec<f64>>,
    /// Covariance of the noise, m × m.
    pub noise: &'a [f64],
    /// Gate that it has to pass, if any.
    pub gate: Option<Gate>,
}

/// Filter of any size.
pub trait SizedFilter: Send + Sync {
    /// Number of components.
    fn size(&self) -> usize;
    /// The present belief.
    fn belief(&self) -> Belief;
    /// Replaces the belief.
    fn reset(&mut self, belief: &Belief) -> Result<(), FilterError>;
    /// Sigma points of the present belief, one after the other, the centre first.
    fn points(&self) -> Vec<f64>;
    /// Moves the belief through a process, and adds its noise.
    fn predict(
        &mut self,
        process: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
        noise: &[f64],
    ) -> Result<(), FilterError>;
    /// Corrects by a measurement, unless it lies beyond the limit.
    fn correct(&mut self, measured: &Measured<'_>) -> Result<CorrectionOfFilter, FilterError>;
    /// The filter itself, for who knows its size.
    fn as_any_mut(&mut self) -> &mut dyn Any;
}

impl<const N: usize> SizedFilter for Ukf<N> {
    fn size(&self) -> usize {
        N
    }

    fn belief(&self) -> Belief {
        let state = self.state();
        Belief {
            mean: state.mean.as_slice().to_vec(),
            covariance: state.covariance.as_slice().to_vec(),
        }
    }

    fn reset(&mut self, belief: &Belief) -> Result<(), FilterError> {
        Ukf::reset(self, &gaussian(belief))
    }

    fn points(&self) -> Vec<f64> {
        let points = self.sigma_points();
        let outer = points.plus.iter().chain(points.minus.iter());
        points.centre.iter().chain(outer).copied().collect()
    }

    fn predict(
        &mut self,
        process: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
        noise: &[f64],
    ) -> Result<(), FilterError> {
        let moved = |state: &SVector<f64, N>| {
            // Without an answer the filter refuses the step, and stays as it is.
            let moved = process(state.as_slice()).filter(|moved| moved.len() == N);
            moved.map_or_else(
                || SVector::repeat(f64::NAN),
                |moved| SVector::from_column_slice(&moved),
            )
        };
        Ukf::predict(self, moved, &SMatrix::from_column_slice(noise))?;
        Ok(())
    }

    fn correct(&mut self, measured: &Measured<'_>) -> Result<CorrectionOfFilter, FilterError> {
        let size = measured.values.len();
        let model = |state: &SVector<f64, N>| {
            let expected = (measured.model)(state.as_slice());
            expected.map(DVector::from_vec)
        };
        let noise = DMatrix::from_row_slice(size, size, measured.noise);
        let values = DVector::from_column_slice(measured.values);
        let predicted = self.predict_measurement::<Dyn>(model, &noise)?;
        let innovation = predicted.innovation(&values);
        let nis = predicted.nis(&innovation);
        let verdict = measured.gate.map(|gate| gate.verdict(nis, size));
        let gain = if verdict.is_some_and(|verdict| !verdict.accepted) {
            None
        } else {
            let correction = Ukf::correct(self, &predicted, &values)?;
            Some(correction.gain.transpose().as_slice().to_vec())
        };
        Ok(CorrectionOfFilter {
            innovation: innovation.as_slice().to_vec(),
            innovation_covariance: predicted.innovation_covariance.as_slice().to_vec(),
            gain,
            nis,
            limit: verdict.map_or(f64::INFINITY, |verdict| verdict.threshold),
        })
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }
}

fn gaussian<const N: usize>(belief: &Belief) -> Gaussian<N> {
    Gaussian::new(
        SVector::from_column_slice(&belief.mean),
        SMatrix::from_column_slice(&belief.covariance),
    )
}

/// A filter of as many components as `belief` has; `None` if they are none or more than [`MOST`].
pub fn sized_filter(
    belief: &Belief,
    settings: UnscentedSettings,
    kappa: f64,
) -> Option<Result<Box<dyn SizedFilter>, FilterError>> {
    fn made<const N: usize>(
        belief: &Belief,
        settings: UnscentedSettings,
        kappa: f64,
    ) -> Result<Box<dyn SizedFilter>, FilterError> {
        Ok(Box::new(Ukf::<N>::with_kappa(
            gaussian(belief),
            settings,
            kappa,
        )?))
    }
    let make = match belief.mean.len() {
        1 => made::<1>,
        2 => made::<2>,
        3 => made::<3>,
        4 => made::<4>,
        5 => made::<5>,
        6 => made::<6>,
        7 => made::<7>,
        8 => made::<8>,
        9 => made::<9>,
        10 => made::<10>,
        11 => made::<11>,
        MOST => made::<MOST>,
        _ => return None,
    };
    Some(make(belief, settings, kappa))
}
