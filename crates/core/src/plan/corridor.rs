//! The region that holds a stated share of a mixture of Gaussians.
//!
//! Whether a landmark will be recognised is not known before the flight. Each way in which that may
//! turn out is a world with a covariance of its own; the error of the flight is drawn from one of them.
//! Their mean covariance is that of the mixture, but a mixture has heavier tails than a Gaussian.

use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize};

use crate::filter::chi_square_quantile;

/// Directions in which the probability of an ellipse is integrated.
const DIRECTIONS: usize = 32;

/// The ellipse and the strip that hold the error with a stated probability.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Corridor {
    /// Covariance of the error (north, east) over all worlds, m².
    pub covariance: Matrix2<f64>,
    /// Standard deviation along the longer axis, metres.
    pub sigma_major: f64,
    /// Standard deviation along the shorter axis, metres.
    pub sigma_minor: f64,
    /// Direction of the longer axis, radians clockwise from north, 0 to π.
    pub heading_of_major: f64,
    /// The ellipse of the covariance times this holds the error with the stated probability; 2.45 for
    /// 95 % of a Gaussian.
    pub scale: f64,
    /// Half width across `course` of the strip that holds it, metres.
    pub across: f64,
    /// Half length along `course`, metres.
    pub along: f64,
}

/// The corridor of equally likely worlds with these position covariances, for a flight on `course`
/// (radians clockwise from north). `None` without a world or where a covariance is not positive.
pub fn corridor(worlds: &[Matrix2<f64>], course: f64, probability: f64) -> Option<Corridor> {
    let mean = worlds.iter().sum::<Matrix2<f64>>() / worlds.len() as f64;
    let eigen = mean.symmetric_eigen();
    let major = eigen.eigenvalues.imax();
    let (sigma_major, sigma_minor) = (
        eigen.eigenvalues[major].max(0.0).sqrt(),
        eigen.eigenvalues[1 - major].max(0.0).sqrt(),
    );
    let axis = eigen.eigenvectors.column(major);
    let root = mean.cholesky()?.l();
    // In the coordinates where the mean is a unit circle.
    let inverse = root.try_inverse()?;
    let whitened: Option<Vec<Matrix2<f64>>> = worlds
        .iter()
        .map(|w| (inverse * w * inverse.transpose()).try_inverse())
        .collect();
    let whitened = whitened?;
    let along = Vector2::new(course.cos(), course.sin());
    let across = Vector2::new(-course.sin(), course.cos());
    Some(Corridor {
        covariance: mean,
        sigma_major,
        sigma_minor,
        heading_of_major: axis[1].atan2(axis[0]).rem_euclid(std::f64::consts::PI),
        scale: radius(&whitened, probability),
        across: half_width(worlds, &across, probability),
        along: half_width(worlds, &along, probability),
    })
}

/// Radius of the circle that holds the mixture of Gaussians with these inverse covariances.
///
/// In polar coordinates the radial integral is closed: a Gaussian with inverse covariance A has
/// `√|A| / 2π ∫ (1 - exp(-r² q/2)) / q dφ` within r, where q = uᵀ A u for the direction u of φ.
fn radius(inverses: &[Matrix2<f64>], probability: f64) -> f64 {
    let within = |r: f64| {
        let sum: f64 = inverses
            .iter()
            .map(|a| {
                let ring: f64 = (0..DIRECTIONS)
                    .map(|i| {
                        let (sin, cos) =
                            (std::f64::consts::PI * i as f64 / DIRECTIONS as f64).sin_cos();
                        let u = Vector2::new(cos, sin);
                        let q = (a * u).dot(&u);
                        (1.0 - (-0.5 * r * r * q).exp()) / q
                    })
                    .sum();
                a.determinant().max(0.0).sqrt() * ring / DIRECTIONS as f64
            })
            .sum();
        sum / inverses.len() as f64
    };
    solve(within, probability)
}

/// Half width of the strip around zero along `direction` that holds the mixture.
fn half_width(worlds: &[Matrix2<f64>], direction: &Vector2<f64>, probability: f64) -> f64 {
    let variances: Vec<f64> = worlds
        .iter()
        .map(|w| (w * direction).dot(direction))
        .collect();
    let scale = (variances.iter().sum::<f64>() / variances.len() as f64).sqrt();
    let within = |r: f64| {
        let half = r * scale;
        let inside = |v: &f64| crate::filter::chi_square_probability(half * half / v, 1.0);
        variances.iter().map(inside).sum::<f64>() / variances.len() as f64
    };
    scale * solve(within, probability)
}

/// Where the growing `within` reaches `probability`, by bisection to a ten-thousandth.
fn solve(within: impl Fn(f64) -> f64, probability: f64) -> f64 {
    let mut low = 0.0;
    let mut high = 2.0 * chi_square_quantile(probability, 2.0).sqrt();
    while within(high) < probability && high < 1e3 {
        high *= 2.0;
    }
    while high - low > 1e-4 {
        let middle = 0.5 * (low + high);
        if within(middle) < probability {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    #[test]
    fn one_world_has_the_corridor_of_its_gaussian() {
        let world = Matrix2::new(25.0, 0.0, 0.0, 4.0);
        let found = corridor(&[world], 0.0, 0.95).unwrap();
        assert!((found.scale - 5.991_f64.sqrt()).abs() < 1e-3, "{found:?}");
        assert!((found.along - 1.96 * 5.0).abs() < 2e-3, "{found:?}");
        assert!((found.across - 1.96 * 2.0).abs() < 2e-3, "{found:?}");
        assert_eq!((found.sigma_major, found.sigma_minor), (5.0, 2.0));
        assert!(found.heading_of_major.abs() < 1e-9);
    }

    #[test]
    fn the_corridor_of_two_worlds_holds_its_share_of_errors_drawn_from_them() {
        let worlds = [
            Matrix2::new(1.0, 0.3, 0.3, 2.0),
            Matrix2::new(90.0, -20.0, -20.0, 40.0),
        ];
        let course = 0.7;
        let found = corridor(&worlds, course, 0.95).unwrap();
        let inverse = found.covariance.try_inverse().unwrap();
        let across = Vector2::new(-f64::sin(course), f64::cos(course));
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(5);
        let (mut ellipse, mut strip) = (0, 0);
        let n = 40_000;
        for i in 0..n {
            let root = worlds[i % 2].cholesky().unwrap().l();
            let z = Vector2::from_fn(|_, _| {
                let value: f64 = StandardNormal.sample(&mut random);
                value
            });
            let error = root * z;
            ellipse += usize::from((inverse * error).dot(&error) <= found.scale * found.scale);
            strip += usize::from(error.dot(&across).abs() <= found.across);
        }
        for share in [ellipse, strip].map(|c| c as f64 / n as f64) {
            assert!((share - 0.95).abs() < 0.005, "{share}");
        }
        assert!(
            found.scale > 2.45,
            "heavier tails than a Gaussian: {found:?}"
        );
    }
}
