//! A state of the estimator and how uncertain it is.

use nalgebra::{DMatrix, DVector, Matrix2};
use serde::{Deserialize, Serialize};

use pilotage_base::frames::GroundPoint;
use pilotage_estimation::filter::Gaussian;

/// A state and its covariance; the first two components are north and east, metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// Mean, n.
    pub mean: DVector<f64>,
    /// Covariance, n × n.
    pub covariance: DMatrix<f64>,
}

impl<const N: usize> From<&Gaussian<N>> for Estimate {
    fn from(belief: &Gaussian<N>) -> Self {
        Self {
            mean: DVector::from_column_slice(belief.mean.as_slice()),
            covariance: DMatrix::from_column_slice(N, N, belief.covariance.as_slice()),
        }
    }
}

impl Estimate {
    /// Position part of the mean.
    pub fn position(&self) -> GroundPoint {
        GroundPoint::new(self.mean[0], self.mean[1])
    }

    /// Greatest variance of the position in any direction, m².
    ///
    /// ```
    /// use nalgebra::{dmatrix, dvector};
    /// use pilotage_base::frames::GroundPoint;
    /// use pilotage_navigator::navigator::Estimate;
    ///
    /// let (mean, covariance) = (dvector![10.0, 20.0], dmatrix![5.0, 4.0; 4.0, 5.0]);
    /// let estimate = Estimate { mean, covariance };
    /// assert_eq!(estimate.position(), GroundPoint::new(10.0, 20.0));
    /// // Along north-east: 5 + 4.
    /// assert!((estimate.greatest_variance() - 9.0).abs() < 1e-9);
    /// ```
    pub fn greatest_variance(&self) -> f64 {
        let along = self.position_covariance().symmetric_eigenvalues();
        along.max().max(0.0)
    }

    /// Position part of the covariance (north, east), m².
    pub fn position_covariance(&self) -> Matrix2<f64> {
        self.covariance.fixed_view::<2, 2>(0, 0).into_owned()
    }
}
