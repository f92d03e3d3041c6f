//! The extended Kalman filter: the same corrections as the unscented one, along slopes.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector, SMatrix, SVector};

use super::ukf::Ukf;
use super::{
    Correction, FilterError, Gaussian, PredictedMeasurement, Prediction, Redraw, SigmaPoints,
    UnscentedSettings,
};

/// Extended Kalman filter over `N` state components (Bar-Shalom, Li and Kirubarajan 2001, table
/// 10.3.3-1, first order).
///
/// The process model moves the mean, its Jacobian F the covariance, P⁻ = F P Fᵀ + Q; the measurement
/// model's Jacobian H gives S = H P Hᵀ + R and the gain. Like [`Ukf`] it holds a triangular root of P and
/// moves it by orthogonal transformations, so that P stays positive semidefinite.
#[derive(Clone, Debug)]
pub struct Ekf<const N: usize>(Ukf<N>);

impl<const N: usize> Ekf<N> {
    /// A filter that believes `prior`; `shown` says how far from the mean the sigma points lie that are
    /// shown of it. The filter itself uses none.
    ///
    /// ```
    /// use nalgebra::{Matrix1, Vector1};
    /// use pilotage_estimation::filter::{Ekf, Gaussian, UnscentedSettings};
    ///
    /// let prior = Gaussian::new(Vector1::new(3.0), Matrix1::new(0.25));
    /// let mut filter = Ekf::new(prior, UnscentedSettings::default())?;
    /// // x² is measured: 9 expected, slope 6, so that S = 6 · 0.25 · 6 + 1 and the gain is 1.5 / S.
    /// let predicted =
    ///     filter.predict_measurement(Vector1::new(9.0), &Matrix1::new(6.0), &Matrix1::new(1.0))?;
    /// filter.correct(&predicted, &Vector1::new(10.0))?;
    /// assert!((filter.mean()[0] - (3.0 + 1.5 / 10.0)).abs() < 1e-12);
    /// # Ok::<(), pilotage_estimation::filter::FilterError>(())
    /// ```
    pub fn new(prior: Gaussian<N>, shown: UnscentedSettings) -> Result<Self, FilterError> {
        let settings = UnscentedSettings {
            redraw: Redraw::AfterProcessNoise,
            ..shown
        };
        Ok(Self(Ukf::new(prior, settings)?))
    }

    /// The present belief.
    pub fn state(&self) -> Gaussian<N> {
        self.0.state()
    }

    /// The present mean.
    pub fn mean(&self) -> &SVector<f64, N> {
        self.0.mean()
    }

    /// Sigma points of the present belief, for those who want to see them.
    pub fn sigma_points(&self) -> SigmaPoints<N> {
        self.0.sigma_points()
    }

    /// Replaces the belief, for a fresh start.
    pub fn reset(&mut self, belief: &Gaussian<N>) -> Result<(), FilterError> {
        self.0.reset(belief)
    }

    /// Moves the belief to `moved`, where the process model sends its mean, along the model's Jacobian
    /// `transition` there (N × N), and adds `process_noise` of covariance Q, which may be singular.
    ///
    /// The sigma points of the answer are moved along the Jacobian too.
    pub fn predict(
        &mut self,
        moved: SVector<f64, N>,
        transition: &SMatrix<f64, N, N>,
        process_noise: &SMatrix<f64, N, N>,
    ) -> Result<Prediction<N>, FilterError> {
        self.0.predict_along(moved, transition, process_noise)
    }

    /// Predicts a measurement: `mean` by the measurement model at the present mean, its Jacobian there (m ×
    /// N), and the `noise` R (m × m).
    pub fn predict_measurement<M: Dim>(
        &self,
        mean: OVector<f64, M>,
        jacobian: &OMatrix<f64, M, Const<N>>,
        noise: &OMatrix<f64, M, M>,
    ) -> Result<PredictedMeasurement<N, M>, FilterError>
    where
        DefaultAllocator:
            Allocator<M> + Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
    {
        self.0.predict_measurement_along(mean, jacobian, noise)
    }

    /// Corrects the belief with `measurement`. `predicted` must come from this filter as it is now.
    pub fn correct<M: Dim>(
        &mut self,
        predicted: &PredictedMeasurement<N, M>,
        measurement: &OVector<f64, M>,
    ) -> Result<Correction<N, M>, FilterError>
    where
        DefaultAllocator:
            Allocator<M> + Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
    {
        self.0.correct(predicted, measurement)
    }

    /// As [`Self::correct`], for an innovation that the caller formed, where components are angles.
    pub fn correct_by<M: Dim>(
        &mut self,
        predicted: &PredictedMeasurement<N, M>,
        innovation: OVector<f64, M>,
    ) -> Result<Correction<N, M>, FilterError>
    where
        DefaultAllocator:
            Allocator<M> + Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
    {
        self.0.correct_by(predicted, innovation)
    }
}
