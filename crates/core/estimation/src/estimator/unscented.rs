//! The unscented Kalman filter as an estimator of a vehicle.

use nalgebra::{DMatrix, DVector, Dyn};

use super::kind::{Corrected, Estimator, EstimatorInfo, Expectation, FilterSettings, StateModel};
use crate::filter::{FilterError, Gaussian, Prediction, SigmaPoints, Ukf};
use crate::vehicle::{ControlInput, VehicleModel};

/// Description for people.
pub(super) const INFO: EstimatorInfo = EstimatorInfo {
    key: "ukf",
    label: "Unscented Kalman filter",
    description: "Propagates sigma points through the models; assumes a Gaussian.",
};

impl<const N: usize> Estimator<N> for Ukf<N> {
    fn begin(prior: &Gaussian<N>, settings: &FilterSettings) -> Result<Self, FilterError> {
        Self::new(*prior, settings.points)
    }

    fn belief(&self) -> Gaussian<N> {
        self.state()
    }

    fn points(&self) -> SigmaPoints<N> {
        self.sigma_points()
    }

    fn measurement_points(&self) -> SigmaPoints<N> {
        Ukf::measurement_points(self)
    }

    fn predict<V: VehicleModel<N>>(
        &mut self,
        model: &V,
        input: &ControlInput,
        dt: f64,
    ) -> Result<Prediction<N>, FilterError> {
        let noise = model.noise_of_belief(&self.state(), input, dt);
        Ukf::predict(self, |x| model.propagate(x, input, dt), &noise)
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
        Ok(self.predict_measurement::<Dyn>(model.of, noise)?.into())
    }

    fn correct(
        &mut self,
        model: &StateModel<'_, N>,
        noise: &DMatrix<f64>,
        measurement: &DVector<f64>,
    ) -> Result<Corrected<N>, FilterError> {
        let predicted = self.predict_measurement::<Dyn>(model.of, noise)?;
        Ok(Ukf::correct(self, &predicted, measurement)?.into())
    }
}
