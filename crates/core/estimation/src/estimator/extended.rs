//! The extended Kalman filter as an estimator of a vehicle.

use nalgebra::{DMatrix, DVector, Dyn};

use super::kind::{Corrected, Estimator, EstimatorInfo, Expectation, FilterSettings, StateModel};
use crate::filter::{
    Ekf, FilterError, Gaussian, PredictedMeasurement, Prediction, SigmaPoints, partial_jacobian,
};
use crate::vehicle::{ControlInput, VehicleModel};

/// Description for people.
pub(super) const INFO: EstimatorInfo = EstimatorInfo {
    key: "ekf",
    label: "Extended Kalman filter",
    description: "Propagates the mean and the slopes of the models; assumes a Gaussian.",
};

impl<const N: usize> StateModel<'_, N> {
    /// Measurement that `filter` expects under this model.
    fn expected_by(
        &self,
        filter: &Ekf<N>,
        noise: &DMatrix<f64>,
    ) -> Result<PredictedMeasurement<N, Dyn>, FilterError> {
        let none = FilterError::NoMeasurement { point: 0 };
        let mean = (self.of)(filter.mean()).ok_or_else(|| none.clone())?;
        let slope = partial_jacobian(self.of, filter.mean(), self.depends_on).ok_or(none)?;
        filter.predict_measurement(mean, &slope, noise)
    }
}

impl<const N: usize> Estimator<N> for Ekf<N> {
    fn begin(prior: &Gaussian<N>, settings: &FilterSettings) -> Result<Self, FilterError> {
        Self::new(*prior, settings.points)
    }

    fn belief(&self) -> Gaussian<N> {
        self.state()
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
        let noise = model.noise_of_belief(&self.state(), input, dt);
        let transition = model.transition(self.mean(), input, dt);
        let moved = model.propagate(self.mean(), input, dt);
        Ekf::predict(self, moved, &transition, &noise)
    }

    fn fade(&mut self, factor: f64) -> Result<(), FilterError> {
        let mut belief = self.state();
        belief.covariance *= factor;
        self.reset(&belief)
    }

    fn expect(
        &self,
        model: &StateModel<'_, N>,
        noise: &DMatrix<f64>,
    ) -> Result<Expectation, FilterError> {
        Ok(model.expected_by(self, noise)?.into())
    }

    fn correct(
        &mut self,
        model: &StateModel<'_, N>,
        noise: &DMatrix<f64>,
        measurement: &DVector<f64>,
    ) -> Result<Corrected<N>, FilterError> {
        let predicted = model.expected_by(self, noise)?;
        Ok(Ekf::correct(self, &predicted, measurement)?.into())
    }
}
