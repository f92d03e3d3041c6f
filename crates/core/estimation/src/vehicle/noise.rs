//! Parts of which process noise is made.
//!
//! White noise that enters a rate is given by its density: the standard deviation that it piles up
//! in one second, in units per √s (equal to units of the rate per √Hz). Its square times `dt` is
//! the variance after `dt`, whatever the length of the steps.

use nalgebra::{SMatrix, SVector};

/// Adds a random walk on component `index` that also moves the state at the rate `effect` per unit.
///
/// With q the squared density, the integral of e(s) e(s)ᵀ q over the step, e(s) = `effect` s + unit
/// vector, is q (`effect effectᵀ` dt³/3 + (`effect unitᵀ` + transpose) dt²/2 + `unit unitᵀ` dt).
pub(super) fn add_integrated_random_walk<const N: usize>(
    noise: &mut SMatrix<f64, N, N>,
    index: usize,
    effect: &SVector<f64, N>,
    density: f64,
    dt: f64,
) {
    let q = density * density;
    *noise += effect * effect.transpose() * (q * dt * dt * dt / 3.0);
    for i in 0..N {
        let coupling = effect[i] * q * dt * dt / 2.0;
        noise[(i, index)] += coupling;
        noise[(index, i)] += coupling;
    }
    noise[(index, index)] += q * dt;
}

/// Adds white noise of `density` whose unit impulse has moved the state by `effect(s)` when s seconds
/// have passed since.
///
/// The integral of `effect effectᵀ` over the step by the eight points of Gauss and Legendre: exact for
/// polynomials of the 15th degree, and a sum of squares for every effect.
pub(super) fn add_white_noise<const N: usize>(
    noise: &mut SMatrix<f64, N, N>,
    density: f64,
    dt: f64,
    effect: impl Fn(f64) -> SVector<f64, N>,
) {
    /// Places, in half steps from the middle, and weights (Abramowitz and Stegun, table 25.4).
    const POINTS: [(f64, f64); 4] = [
        (0.183_434_642_495_649_8, 0.362_683_783_378_362),
        (0.525_532_409_916_329, 0.313_706_645_877_887_3),
        (0.796_666_477_413_626_7, 0.222_381_034_453_374_47),
        (0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
    ];
    for (place, weight) in POINTS {
        for side in [-1.0, 1.0] {
            let effect = effect(0.5 * dt * (1.0 + side * place));
            *noise += effect * effect.transpose() * (0.5 * dt * weight * density * density);
        }
    }
}

/// A first-order Gauss-Markov process (an exponentially correlated velocity such as a gust).
#[derive(Clone, Copy, Debug)]
pub(super) struct GaussMarkov {
    /// Share of the value that is left after the step.
    pub(super) persistence: f64,
    /// Seconds for which the value of the beginning moves the position.
    pub(super) travel: f64,
    /// Variance of the value that the step adds.
    pub(super) value_variance: f64,
    /// Covariance of value and position that the step adds.
    pub(super) coupling: f64,
    /// Variance of the position that the step adds.
    pub(super) position_variance: f64,
}

impl GaussMarkov {
    /// With stationary standard deviation `deviation` and correlation time `time` seconds, over a
    /// step of `dt` seconds.
    ///
    /// With x = dt/τ, φ = e⁻ˣ: value σ²(1 - φ²), coupling σ²τ(1 - φ)², position
    /// σ²τ²(2x - 3 + 4φ - φ²); the last as a series where it would cancel.
    pub(super) fn over(deviation: f64, time: f64, dt: f64) -> Self {
        let x = dt / time;
        let gone = -(-x).exp_m1();
        let persistence = 1.0 - gone;
        let variance = deviation * deviation;
        let position = if x < 0.02 {
            x * x * x * (2.0 / 3.0 - x * (0.5 - x * (7.0 / 30.0 - x * (1.0 / 12.0))))
        } else {
            2.0 * x - 3.0 + persistence * (4.0 - persistence)
        };
        Self {
            persistence,
            travel: time * gone,
            value_variance: variance * gone * (1.0 + persistence),
            coupling: variance * time * gone * gone,
            position_variance: variance * time * time * position,
        }
    }

    /// Adds the noise of a process at `value` that moves `position`.
    pub(super) fn add_to<const N: usize>(
        &self,
        noise: &mut SMatrix<f64, N, N>,
        position: usize,
        value: usize,
    ) {
        noise[(position, position)] += self.position_variance;
        noise[(position, value)] += self.coupling;
        noise[(value, position)] += self.coupling;
        noise[(value, value)] += self.value_variance;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_gust_spreads_the_position_alike_in_one_step_and_in_a_thousand() {
        let (deviation, time, dt) = (2.0, 5.0, 3.0);
        let once = GaussMarkov::over(deviation, time, dt);
        let part = GaussMarkov::over(deviation, time, dt / 1000.0);
        let mut transition = nalgebra::Matrix2::identity();
        transition[(0, 1)] = part.travel;
        transition[(1, 1)] = part.persistence;
        let mut added = nalgebra::Matrix2::zeros();
        part.add_to(&mut added, 0, 1);
        let mut covariance = nalgebra::Matrix2::zeros();
        for _ in 0..1000 {
            covariance = transition * covariance * transition.transpose() + added;
        }
        assert_relative_eq!(
            covariance[(0, 0)],
            once.position_variance,
            max_relative = 1e-9
        );
        assert_relative_eq!(covariance[(0, 1)], once.coupling, max_relative = 1e-9);
        assert_relative_eq!(covariance[(1, 1)], once.value_variance, max_relative = 1e-9);
    }

    #[test]
    fn the_series_for_short_steps_meets_the_formula() {
        let below = GaussMarkov::over(1.0, 1.0, 0.019_999_999);
        let above = GaussMarkov::over(1.0, 1.0, 0.020_000_001);
        let slope = (above.position_variance / below.position_variance - 1.0) / 1e-7;
        // d ln(x³)/d ln x = 3, over a relative step of 1e-7.
        assert_relative_eq!(slope, 3.0, max_relative = 2e-2);
    }
}
