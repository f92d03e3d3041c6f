//! The posterior Cramér-Rao bound: how well any estimator can do.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, Matrix2, OMatrix, OVector, SMatrix, SVector};
use serde::{Deserialize, Serialize};

use super::FilterError;
use super::root::{cholesky_root, solve_lower, solve_upper};

/// Bayesian information along a known true path, for additive Gaussian noise.
///
/// Tichavský, Muravchik and Nehorai 1998: the covariance of the error of any estimator is at least
/// the inverse of the information J, with
/// `J⁺ = (Q + F J⁻¹ Fᵀ)⁻¹` for a step with process noise Q (their eq. 21 by the matrix inversion
/// lemma, which also holds for singular Q), and `J⁺ = J + Hᵀ R⁻¹ H` for a measurement; F and H are
/// Jacobians at the truth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CramerRao<const N: usize> {
    /// Information, the inverse of the bound on the covariance.
    pub information: SMatrix<f64, N, N>,
}

impl<const N: usize> CramerRao<N> {
    /// Information of a prior with this covariance.
    ///
    /// ```
    /// use nalgebra::Matrix2;
    /// use pilotage_estimation::filter::CramerRao;
    ///
    /// // A position known to 2 m on each axis is measured to 2 m: 2 m² are left on each.
    /// let mut bound = CramerRao::<2>::from_prior(&(Matrix2::identity() * 4.0))?;
    /// bound.update(&Matrix2::identity(), &(Matrix2::identity() * 4.0))?;
    /// assert!((bound.position_bound()? - 2.0).abs() < 1e-12); // √(2 + 2)
    /// # Ok::<(), pilotage_estimation::filter::FilterError>(())
    /// ```
    pub fn from_prior(covariance: &SMatrix<f64, N, N>) -> Result<Self, FilterError> {
        Ok(Self {
            information: inverse(covariance, "prior covariance")?,
        })
    }

    /// Carries the information through a step of the process.
    pub fn predict(
        &mut self,
        transition: &SMatrix<f64, N, N>,
        process_noise: &SMatrix<f64, N, N>,
    ) -> Result<(), FilterError> {
        let covariance = transition * self.covariance()? * transition.transpose() + process_noise;
        self.information = inverse(&symmetric(covariance), "predicted bound")?;
        Ok(())
    }

    /// Adds the information of a measurement.
    pub fn update<M: Dim>(
        &mut self,
        measurement_jacobian: &OMatrix<f64, M, Const<N>>,
        measurement_noise: &OMatrix<f64, M, M>,
    ) -> Result<(), FilterError>
    where
        DefaultAllocator: Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
    {
        let root = cholesky_root(measurement_noise, "measurement noise")?;
        let half: OMatrix<f64, M, Const<N>> =
            solve_lower::<M, Const<N>>(&root, measurement_jacobian.clone_owned());
        for i in 0..N {
            for j in 0..N {
                for k in 0..half.nrows() {
                    self.information[(i, j)] += half[(k, i)] * half[(k, j)];
                }
            }
        }
        Ok(())
    }

    /// Bound on the covariance of the error.
    pub fn covariance(&self) -> Result<SMatrix<f64, N, N>, FilterError> {
        inverse(&self.information, "information")
    }

    /// Bound on the covariance of the position, components 0 and 1.
    pub fn position_covariance(&self) -> Result<Matrix2<f64>, FilterError> {
        let covariance = self.covariance()?;
        Ok(Matrix2::from_fn(|i, j| covariance[(i, j)]))
    }

    /// Bound on the root mean square distance between estimated and true position, metres.
    pub fn position_bound(&self) -> Result<f64, FilterError> {
        Ok(self.position_covariance()?.trace().sqrt())
    }
}

fn inverse<const N: usize>(
    matrix: &SMatrix<f64, N, N>,
    name: &'static str,
) -> Result<SMatrix<f64, N, N>, FilterError> {
    let root = cholesky_root(matrix, name)?;
    let identity = SMatrix::<f64, N, N>::identity();
    Ok(symmetric(solve_upper(&root, solve_lower(&root, identity))))
}

fn symmetric<const N: usize>(matrix: SMatrix<f64, N, N>) -> SMatrix<f64, N, N> {
    (matrix + matrix.transpose()) * 0.5
}

/// Jacobian of `function` at `place` by central differences, or `None` where it has no answer.
///
/// Steps are ∛ε of each component's size (at least of 1), where rounding and curvature balance.
pub fn numerical_jacobian<const N: usize, M: Dim>(
    function: impl Fn(&SVector<f64, N>) -> Option<OVector<f64, M>>,
    place: &SVector<f64, N>,
) -> Option<OMatrix<f64, M, Const<N>>>
where
    DefaultAllocator: Allocator<M> + Allocator<M, Const<N>>,
{
    let size = function(place)?.shape_generic().0;
    let mut jacobian = OMatrix::zeros_generic(size, Const::<N>);
    for j in 0..N {
        let step = f64::EPSILON.cbrt() * place[j].abs().max(1.0);
        let (mut above, mut below) = (*place, *place);
        above[j] += step;
        below[j] -= step;
        let (upper, lower): (OVector<f64, M>, OVector<f64, M>) =
            (function(&above)?, function(&below)?);
        let width = above[j] - below[j];
        for i in 0..size.value() {
            jacobian[(i, j)] = (upper[(i, 0)] - lower[(i, 0)]) / width;
        }
    }
    Some(jacobian)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::{Matrix1, Matrix1x2, U1, Vector1, Vector2};

    #[test]
    fn the_bound_of_a_linear_system_is_the_covariance_of_the_kalman_filter() {
        let transition = Matrix2::new(1.0, 0.5, 0.0, 1.0);
        // Singular: the noise enters through one direction.
        let noise = Matrix2::new(0.01, 0.02, 0.02, 0.04);
        let jacobian = Matrix1x2::new(1.0, 0.0);
        let measurement_noise = Matrix1::new(0.3);
        let mut covariance = Matrix2::new(4.0, 0.5, 0.5, 1.0);
        let mut bound = CramerRao::from_prior(&covariance).unwrap();
        for _ in 0..50 {
            bound.predict(&transition, &noise).unwrap();
            bound.update(&jacobian, &measurement_noise).unwrap();
            covariance = transition * covariance * transition.transpose() + noise;
            let s = (jacobian * covariance * jacobian.transpose() + measurement_noise)[0];
            let gain = covariance * jacobian.transpose() / s;
            covariance -= gain * s * gain.transpose();
            assert_relative_eq!(bound.covariance().unwrap(), covariance, max_relative = 1e-9);
        }
        assert_relative_eq!(
            bound.position_bound().unwrap(),
            covariance.trace().sqrt(),
            max_relative = 1e-9
        );
    }

    #[test]
    fn the_numerical_jacobian_of_range_and_bearing_is_the_analytic_one() {
        let place = Vector2::new(300.0, -40.0);
        let jacobian =
            numerical_jacobian(|x| Some(Vector2::new(x.norm(), x.y.atan2(x.x))), &place).unwrap();
        let r = place.norm();
        let exact = Matrix2::new(
            place.x / r,
            place.y / r,
            -place.y / (r * r),
            place.x / (r * r),
        );
        assert_relative_eq!(jacobian, exact, max_relative = 1e-7);
        assert!(numerical_jacobian::<2, U1>(|_| None, &place).is_none());
        assert!(numerical_jacobian(|x| Some(Vector1::new(x.x)), &place).is_some());
    }
}
