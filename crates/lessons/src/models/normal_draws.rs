//! Numbers of a normal distribution, the same ones for the same seed.

use nalgebra::{SMatrix, SVector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Source of standard normal numbers.
///
/// ```
/// use pilotage_lessons::models::NormalDraws;
/// let [mut first, mut second] = [NormalDraws::seeded(4), NormalDraws::seeded(4)];
/// assert_eq!(first.number(), second.number());
/// let squares: f64 = (0..4000).map(|_| first.number().powi(2)).sum();
/// assert!((squares / 4000.0 - 1.0).abs() < 0.08);
/// ```
pub struct NormalDraws(ChaCha8Rng);

impl NormalDraws {
    /// Source that begins anew with every call of the same seed.
    pub fn seeded(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// Next number: mean 0, variance 1.
    pub fn number(&mut self) -> f64 {
        StandardNormal.sample(&mut self.0)
    }

    /// Vector of independent numbers.
    pub fn vector<const N: usize>(&mut self) -> SVector<f64, N> {
        SVector::from_fn(|_, _| self.number())
    }

    /// Vector with a covariance; of one that is not positive definite, with its deviations alone.
    pub fn spread<const N: usize>(&mut self, covariance: &SMatrix<f64, N, N>) -> SVector<f64, N> {
        let numbers = self.vector();
        let alone = || SMatrix::from_diagonal(&covariance.diagonal().map(|v| v.max(0.0).sqrt()));
        let root = covariance.cholesky().map(|root| root.l());
        root.unwrap_or_else(alone) * numbers
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::matrix;

    #[test]
    fn what_is_drawn_has_the_covariance() {
        let covariance = matrix![9.0, 4.0; 4.0, 4.0];
        let mut draws = NormalDraws::seeded(1);
        let mut sum = SMatrix::<f64, 2, 2>::zeros();
        for _ in 0..8000 {
            let drawn = draws.spread(&covariance);
            sum += drawn * drawn.transpose() / 8000.0;
        }
        assert!((sum - covariance).abs().max() < 0.4, "{sum}");
    }
}
