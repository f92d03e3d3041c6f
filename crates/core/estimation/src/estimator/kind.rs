//! Trait of an estimator, whatever it believes in.

use nalgebra::{DMatrix, DVector, Dyn, SVector};

use crate::filter::{
    Correction, FilterError, Gaussian, ParticleSettings, PredictedMeasurement, Prediction,
    SigmaPoints, UnscentedSettings,
};
use crate::vehicle::{ControlInput, VehicleModel};

/// Measurement that is expected, with its covariance.
pub struct Expectation {
    /// Mean, m components.
    pub mean: DVector<f64>,
    /// Covariance with the measurement's noise, m × m.
    pub covariance: DMatrix<f64>,
}

/// Description of an estimator for people.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EstimatorInfo {
    /// Name in files and on the command line.
    pub key: &'static str,
    /// Name for people.
    pub label: &'static str,
    /// Sentence about it.
    pub description: &'static str,
}

/// Settings of which each estimator takes its own.
#[derive(Clone, Copy, Debug)]
pub struct FilterSettings {
    /// Spread of the sigma points, which every estimator shows.
    pub points: UnscentedSettings,
    /// Particles and the chance in them.
    pub particles: ParticleSettings,
}

/// A measurement model over the whole state, and which components it looks at.
pub struct StateModel<'a, const N: usize> {
    /// Measurement function of the state.
    pub of: &'a dyn Fn(&SVector<f64, N>) -> Option<DVector<f64>>,
    /// The components on which it depends: the others have no slope.
    pub depends_on: &'a [usize],
}

/// Result of a correction, in sizes known at run time only.
pub struct Corrected<const N: usize> {
    /// Gain, N × m.
    pub gain: DMatrix<f64>,
    /// Measurement less what was expected, m components.
    pub innovation: DVector<f64>,
    /// Covariance of the innovation, m × m.
    pub innovation_covariance: DMatrix<f64>,
    /// Belief afterwards.
    pub after: Gaussian<N>,
}

impl<const N: usize> From<PredictedMeasurement<N, Dyn>> for Expectation {
    fn from(predicted: PredictedMeasurement<N, Dyn>) -> Self {
        Self {
            mean: predicted.mean,
            covariance: predicted.innovation_covariance,
        }
    }
}

impl<const N: usize> From<Correction<N, Dyn>> for Corrected<N> {
    fn from(step: Correction<N, Dyn>) -> Self {
        Self {
            gain: DMatrix::from_column_slice(N, step.innovation.len(), step.gain.as_slice()),
            innovation: step.innovation,
            innovation_covariance: step.innovation_covariance,
            after: step.after,
        }
    }
}

/// An estimator of a state of N components that moves as a vehicle model says.
pub trait Estimator<const N: usize>: Clone + Send {
    /// Estimator that begins with the belief `prior`.
    fn begin(prior: &Gaussian<N>, settings: &FilterSettings) -> Result<Self, FilterError>;

    /// Mean and covariance of the present belief.
    fn belief(&self) -> Gaussian<N>;

    /// Sigma points of the present belief.
    fn points(&self) -> SigmaPoints<N>;

    /// Those that the next correction begins with.
    fn measurement_points(&self) -> SigmaPoints<N> {
        self.points()
    }

    /// Goes on by `dt` seconds with what the vehicle was measured to do.
    fn predict<V: VehicleModel<N>>(
        &mut self,
        model: &V,
        input: &ControlInput,
        dt: f64,
    ) -> Result<Prediction<N>, FilterError>;

    /// Widens the belief to `factor` times its covariance.
    fn fade(&mut self, factor: f64) -> Result<(), FilterError>;

    /// Measurement that it expects under `model`, with the covariance `noise` (m × m) of the measurement.
    fn expect(
        &self,
        model: &StateModel<'_, N>,
        noise: &DMatrix<f64>,
    ) -> Result<Expectation, FilterError>;

    /// Takes in a measurement of m components.
    fn correct(
        &mut self,
        model: &StateModel<'_, N>,
        noise: &DMatrix<f64>,
        measurement: &DVector<f64>,
    ) -> Result<Corrected<N>, FilterError>;
}

/// Work with an estimator whose type is known only when it runs.
pub trait EstimatorVisitor<const N: usize> {
    /// Result of the work.
    type Output;

    /// Works with the estimator.
    fn visit<F: Estimator<N> + 'static>(self, estimator: F) -> Self::Output;
}
