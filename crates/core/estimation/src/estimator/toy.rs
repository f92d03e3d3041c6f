//! The extended Kalman filter that takes every measurement in two halves, as a toy.
//!
//! # Equations
//!
//! A measurement z with noise R is taken twice with 2 R, since its likelihood is the square of a half's:
//! N(z; h(x), R) ∝ N(z; h(x), 2 R)². With i = 1, 2, each about the x that the other left:
//!
//! Kᵢ = Pᵢ Hᵢᵀ (Hᵢ Pᵢ Hᵢᵀ + 2 R)⁻¹, xᵢ₊₁ = xᵢ + Kᵢ (z − h(xᵢ)), Pᵢ₊₁ = (I − Kᵢ Hᵢ) Pᵢ, with Hᵢ = ∂h/∂x at xᵢ.
//!
//! # Source
//!
//! Progressive correction in two steps (Oudjane and Musso 2000), with the extended Kalman filter's own correction.

use nalgebra::{DMatrix, DVector};

use super::kind::{Corrected, Estimator, EstimatorInfo, Expectation, FilterSettings, StateModel};
use crate::filter::{Ekf, FilterError, Gaussian, Prediction, SigmaPoints};
use crate::vehicle::{ControlInput, VehicleModel};

/// Description for people.
pub(super) const INFO: EstimatorInfo = EstimatorInfo {
    key: "halves",
    label: "Extended Kalman filter in halves",
    description: "Takes each measurement twice with twice its noise, and looks anew at the slopes between.",
};

/// The extended filter beneath.
#[derive(Clone)]
pub(super) struct Halves<const N: usize>(Ekf<N>);

impl<const N: usize> Estimator<N> for Halves<N> {
    fn begin(prior: &Gaussian<N>, settings: &FilterSettings) -> Result<Self, FilterError> {
        Ok(Self(Ekf::new(*prior, settings.points)?))
    }

    fn belief(&self) -> Gaussian<N> {
        Estimator::belief(&self.0)
    }

    fn points(&self) -> SigmaPoints<N> {
        Estimator::points(&self.0)
    }

    fn predict<V: VehicleModel<N>>(
        &mut self,
        model: &V,
        input: &ControlInput,
        dt: f64,
    ) -> Result<Prediction<N>, FilterError> {
        Estimator::predict(&mut self.0, model, input, dt)
    }

    fn fade(&mut self, factor: f64) -> Result<(), FilterError> {
        Estimator::fade(&mut self.0, factor)
    }

    fn expect(
        &self,
        model: &StateModel<'_, N>,
        noise: &DMatrix<f64>,
    ) -> Result<Expectation, FilterError> {
        Estimator::expect(&self.0, model, noise)
    }

    fn correct(
        &mut self,
        model: &StateModel<'_, N>,
        noise: &DMatrix<f64>,
        measurement: &DVector<f64>,
    ) -> Result<Corrected<N>, FilterError> {
        let expected = self.expect(model, noise)?;
        let half = noise * 2.0;
        Estimator::correct(&mut self.0, model, &half, measurement)?;
        let second = Estimator::correct(&mut self.0, model, &half, measurement)?;
        Ok(Corrected {
            innovation: measurement - expected.mean,
            innovation_covariance: expected.covariance,
            ..second
        })
    }
}
