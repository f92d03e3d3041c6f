//! The particle filter as an estimator of a vehicle.

use nalgebra::{DMatrix, DVector, Dyn};

use super::kind::{Corrected, Estimator, EstimatorInfo, Expectation, FilterSettings, StateModel};
use crate::filter::{FilterError, Gaussian, ParticleFilter, Prediction, SigmaPoints};
use crate::vehicle::{ControlInput, VehicleModel};

/// Description for people.
pub(super) const INFO: EstimatorInfo = EstimatorInfo {
    key: "particle",
    label: "Particle filter",
    description: "Propagates many random states through the models; assumes no form of the distribution.",
};

impl<const N: usize> Estimator<N> for ParticleFilter<N> {
    fn begin(prior: &Gaussian<N>, settings: &FilterSettings) -> Result<Self, FilterError> {
        Self::new(prior, settings.particles, settings.points)
    }

    fn belief(&self) -> Gaussian<N> {
        *self.state()
    }

    fn points(&self) -> SigmaPoints<N> {
        self.sigma_points()
    }

    fn predict<V: VehicleModel<N>>(
        &mut self,
        model: &V,
        input: &ControlInput,
        dt: f64,
    ) -> Result<Prediction<N>, FilterError> {
        let noise = model.noise_of_belief(self.state(), input, dt);
        ParticleFilter::predict(self, |x| model.propagate(x, input, dt), &noise)
    }

    fn fade(&mut self, factor: f64) -> Result<(), FilterError> {
        ParticleFilter::fade(self, factor)
    }

    fn expect(
        &self,
        model: &StateModel<'_, N>,
        noise: &DMatrix<f64>,
    ) -> Result<Expectation, FilterError> {
        let predicted = self.predict_measurement::<Dyn>(model.of, noise, |a, b| a - b)?;
        Ok(Expectation {
            mean: predicted.mean,
            covariance: predicted.innovation_covariance,
        })
    }

    fn correct(
        &mut self,
        model: &StateModel<'_, N>,
        noise: &DMatrix<f64>,
        measurement: &DVector<f64>,
    ) -> Result<Corrected<N>, FilterError> {
        let correction =
            ParticleFilter::correct::<Dyn>(self, model.of, noise, measurement, |a, b| a - b)?;
        Ok(correction.into())
    }
}
