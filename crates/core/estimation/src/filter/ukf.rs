//! The unscented Kalman filter: state and prediction.

use nalgebra::{SMatrix, SVector};
use serde::{Deserialize, Serialize};

use super::root::{semidefinite_root, square};
use super::sigma::Spread;
use super::{FilterError, Gaussian, Redraw, SigmaPoints, UnscentedSettings, Weights};

/// Record of a prediction, for those who want to see it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Prediction<const N: usize> {
    /// Belief before the prediction.
    pub before: Gaussian<N>,
    /// Sigma points drawn from the belief before; DeAngelo 2016, eq. 9.
    pub sigma_points_before: SigmaPoints<N>,
    /// The same after the process model, still without process noise; eq. 13.
    pub sigma_points_after: SigmaPoints<N>,
    /// Belief after the prediction; eqs 14 and 15.
    pub after: Gaussian<N>,
}

/// Unscented Kalman filter over `N` state components; DeAngelo 2016, Table 3.
///
/// Holds the lower triangular root L of the covariance P = L Lᵀ and moves it by orthogonal
/// transformations only, so that P is symmetric and positive semidefinite whatever α is. P may be
/// singular: a component without uncertainty and without noise stays without.
#[derive(Clone, Debug)]
pub struct Ukf<const N: usize> {
    pub(super) mean: SVector<f64, N>,
    pub(super) root: SMatrix<f64, N, N>,
    pub(super) settings: UnscentedSettings,
    pub(super) weights: Weights,
    /// The points of the last prediction, for [`Redraw::CarriedThrough`].
    pub(super) carried: Option<Carried<N>>,
    /// Counts changes of the belief, to recognise stale measurement predictions.
    pub(super) revision: u64,
}

/// Propagated points that wait for the next correction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carried<const N: usize> {
    pub(super) points: SigmaPoints<N>,
    pub(super) spread: Spread<N>,
    pub(super) noise_root: SMatrix<f64, N, N>,
}

impl<const N: usize> Ukf<N> {
    /// A filter that believes `prior`.
    pub fn new(prior: Gaussian<N>, settings: UnscentedSettings) -> Result<Self, FilterError> {
        Self::with_kappa(prior, settings, 0.0)
    }

    /// A filter with Merwe's secondary scaling κ, which Table 3 has at 0.
    pub fn with_kappa(
        prior: Gaussian<N>,
        settings: UnscentedSettings,
        kappa: f64,
    ) -> Result<Self, FilterError> {
        if !prior.mean.iter().all(|v| v.is_finite()) {
            return Err(FilterError::NotFinite {
                place: "prior mean",
            });
        }
        Ok(Self {
            mean: prior.mean,
            root: semidefinite_root(&prior.covariance, "prior covariance")?,
            settings,
            weights: Weights::new::<N>(&settings, kappa)?,
            carried: None,
            revision: 0,
        })
    }

    /// The present belief.
    pub fn state(&self) -> Gaussian<N> {
        Gaussian::new(self.mean, square(&self.root))
    }

    /// The present mean.
    pub fn mean(&self) -> &SVector<f64, N> {
        &self.mean
    }

    /// Lower triangular root of the present covariance.
    pub fn covariance_root(&self) -> &SMatrix<f64, N, N> {
        &self.root
    }

    /// The settings it was made with.
    pub fn settings(&self) -> &UnscentedSettings {
        &self.settings
    }

    /// The weights that follow from the settings.
    pub fn weights(&self) -> &Weights {
        &self.weights
    }

    /// Sigma points of the present belief, drawn anew; DeAngelo 2016, eq. 9.
    pub fn sigma_points(&self) -> SigmaPoints<N> {
        SigmaPoints::draw(&self.mean, &self.root, self.weights.eta)
    }

    /// The points that the next measurement prediction sends through the measurement model.
    pub fn measurement_points(&self) -> SigmaPoints<N> {
        self.carried
            .map_or_else(|| self.sigma_points(), |carried| carried.points)
    }

    /// Replaces the belief, for a fresh start.
    pub fn reset(&mut self, belief: &Gaussian<N>) -> Result<(), FilterError> {
        if !belief.mean.iter().all(|v| v.is_finite()) {
            return Err(FilterError::NotFinite { place: "new mean" });
        }
        let root = semidefinite_root(&belief.covariance, "new covariance")?;
        self.commit(belief.mean, root);
        Ok(())
    }

    /// Moves the belief through `process` and adds `process_noise`; DeAngelo 2016, eqs 9-15.
    ///
    /// `process_noise` is the covariance Q of this step and may be singular.
    ///
    /// ```
    /// use nalgebra::{Matrix2, Vector2};
    /// use pilotage_estimation::filter::{Gaussian, Ukf, UnscentedSettings};
    ///
    /// // Position and speed on a line, known to 1 m and 2 m/s.
    /// let (mean, deviations) = (Vector2::new(0.0, 3.0), Vector2::new(1.0, 2.0));
    /// let prior = Gaussian::from_standard_deviations(mean, &deviations);
    /// let mut filter = Ukf::new(prior, UnscentedSettings::default())?;
    /// filter.predict(|x| Vector2::new(x[0] + x[1], x[1]), &Matrix2::zeros())?;
    /// // A second later the variance of the position is 1² + 2².
    /// assert!((filter.mean()[0] - 3.0).abs() < 1e-12);
    /// assert!((filter.state().covariance[(0, 0)] - 5.0).abs() < 1e-12);
    /// # Ok::<(), pilotage_estimation::filter::FilterError>(())
    /// ```
    #[inline]
    pub fn predict(
        &mut self,
        process: impl Fn(&SVector<f64, N>) -> SVector<f64, N>,
        process_noise: &SMatrix<f64, N, N>,
    ) -> Result<Prediction<N>, FilterError> {
        let before = self.state();
        let sigma_points_before = self.sigma_points();
        let noise_root = semidefinite_root(process_noise, "process noise")?;
        let sigma_points_after = sigma_points_before.map(process);
        let spread = Spread::of(&sigma_points_after, &self.weights);

        let root = spread.root_with(&noise_root);
        if !finite(&spread.mean, &root) {
            return Err(FilterError::NotFinite {
                place: "process model",
            });
        }
        self.commit(spread.mean, root);
        if self.settings.redraw == Redraw::CarriedThrough {
            self.carried = Some(Carried {
                points: sigma_points_after,
                spread,
                noise_root,
            });
        }
        Ok(Prediction {
            before,
            sigma_points_before,
            sigma_points_after,
            after: self.state(),
        })
    }

    /// As [`Self::predict`] where the process is linear: to `moved` and along `transition` (N × N).
    pub(super) fn predict_along(
        &mut self,
        moved: SVector<f64, N>,
        transition: &SMatrix<f64, N, N>,
        process_noise: &SMatrix<f64, N, N>,
    ) -> Result<Prediction<N>, FilterError> {
        let before = self.state();
        let sigma_points_before = self.sigma_points();
        let noise_root = semidefinite_root(process_noise, "process noise")?;
        let spread = Spread {
            mean: moved,
            odd: transition * self.root,
            even: SMatrix::zeros(),
            shift: SVector::zeros(),
        };
        let root = spread.root_with(&noise_root);
        if !finite(&moved, &root) {
            return Err(FilterError::NotFinite {
                place: "process model",
            });
        }
        self.commit(moved, root);
        Ok(Prediction {
            before,
            sigma_points_before,
            sigma_points_after: SigmaPoints::draw(&moved, &spread.odd, self.weights.eta),
            after: self.state(),
        })
    }

    pub(super) fn commit(&mut self, mean: SVector<f64, N>, root: SMatrix<f64, N, N>) {
        self.mean = mean;
        self.root = root;
        self.carried = None;
        self.revision += 1;
    }
}

pub(super) fn finite<const N: usize>(mean: &SVector<f64, N>, root: &SMatrix<f64, N, N>) -> bool {
    mean.iter().chain(root.iter()).all(|v| v.is_finite())
}
