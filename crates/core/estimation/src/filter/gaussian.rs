//! A Gaussian belief.

use nalgebra::{SMatrix, SVector};
use serde::{Deserialize, Serialize};

use super::FilterError;
use super::root::{cholesky_root, solve_lower};

/// Mean and covariance of a state with `N` components.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gaussian<const N: usize> {
    /// Mean, in the units of the state.
    pub mean: SVector<f64, N>,
    /// Covariance, symmetric, in products of the units of the state.
    pub covariance: SMatrix<f64, N, N>,
}

impl<const N: usize> Gaussian<N> {
    /// From mean and covariance.
    pub fn new(mean: SVector<f64, N>, covariance: SMatrix<f64, N, N>) -> Self {
        Self { mean, covariance }
    }

    /// Independent components with these standard deviations.
    pub fn from_standard_deviations(
        mean: SVector<f64, N>,
        standard_deviations: &SVector<f64, N>,
    ) -> Self {
        let variances = standard_deviations.component_mul(standard_deviations);
        Self::new(mean, SMatrix::from_diagonal(&variances))
    }

    /// Standard deviation of each component.
    pub fn standard_deviations(&self) -> SVector<f64, N> {
        self.covariance.diagonal().map(|v| v.max(0.0).sqrt())
    }

    /// Normalised estimation error squared: (truth - mean)ᵀ P⁻¹ (truth - mean).
    ///
    /// Chi-square with `N` degrees of freedom when the belief is honest.
    ///
    /// ```
    /// use nalgebra::Vector2;
    /// use pilotage_estimation::filter::Gaussian;
    ///
    /// let (mean, deviations) = (Vector2::new(10.0, 0.0), Vector2::new(2.0, 1.0));
    /// let belief = Gaussian::from_standard_deviations(mean, &deviations);
    /// // Two standard deviations off in one component, one in the other: 2² + 1².
    /// let nees = belief.nees(&Vector2::new(14.0, -1.0))?;
    /// assert!((nees - 5.0).abs() < 1e-12);
    /// # Ok::<(), pilotage_estimation::filter::FilterError>(())
    /// ```
    pub fn nees(&self, truth: &SVector<f64, N>) -> Result<f64, FilterError> {
        let root = cholesky_root(&self.covariance, "state covariance")?;
        Ok(solve_lower(&root, truth - self.mean).norm_squared())
    }

    /// The belief about the components `FIRST..FIRST + K` alone.
    ///
    /// The first two components of every vehicle are its position north and east, so that
    /// `marginal::<0, 2>()` is the position.
    pub fn marginal<const FIRST: usize, const K: usize>(&self) -> Gaussian<K> {
        Gaussian::new(
            self.mean.fixed_rows::<K>(FIRST).into_owned(),
            self.covariance
                .fixed_view::<K, K>(FIRST, FIRST)
                .into_owned(),
        )
    }
}
