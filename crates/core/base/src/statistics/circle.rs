//! Circles about the mean of a position in the plane.

use std::f64::consts::FRAC_PI_2;

use nalgebra::Matrix2;

/// Directions over which is integrated, of a quarter turn.
const DIRECTIONS: usize = 64;

/// Radius of the circle about the mean that holds a Gaussian position with this probability, in the unit of the square
/// root of `covariance`; zero without a covariance.
///
/// A point of the ellipse is ρ (a cos φ, b sin φ) with ρ Rayleigh and φ uniform, so that the circle of radius r holds
/// the mean over φ of 1 − exp(−r² / 2 (a² cos² φ + b² sin² φ)); r is found by bisection.
///
/// ```
/// use nalgebra::Matrix2;
/// use pilotage_base::statistics::circle_radius;
///
/// let radius = circle_radius(&Matrix2::identity(), 0.95);
/// assert!((radius - 2.4477).abs() < 1e-4);
/// ```
pub fn circle_radius(covariance: &Matrix2<f64>, probability: f64) -> f64 {
    // Eigenvalues of two rows, in closed form.
    let middle = 0.5 * covariance.trace();
    let half = (0.5 * (covariance.m11 - covariance.m22)).hypot(covariance.m12);
    let axes = [middle + half, (middle - half).max(0.0)];
    let longest = axes[0].max(0.0).sqrt();
    if longest <= 0.0 || !longest.is_finite() {
        return 0.0;
    }
    let step = FRAC_PI_2 / DIRECTIONS as f64;
    let directions = (0..DIRECTIONS).map(|i| {
        let cos = (step * (i as f64 + 0.5)).cos().powi(2);
        axes[0] * cos + axes[1] * (1.0 - cos)
    });
    let directions: Vec<f64> = directions.collect();
    let held = |radius: f64| {
        let outside = directions
            .iter()
            .map(|v| (-0.5 * radius * radius / v).exp());
        1.0 - outside.sum::<f64>() / DIRECTIONS as f64
    };
    // No axis is longer, so that the circle of that axis alone is the largest.
    let (mut low, mut high) = (0.0, longest * (-2.0 * (1.0 - probability).ln()).sqrt());
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if held(middle) < probability {
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

    /// Values of a midpoint rule with 4,000 directions, computed beside this program.
    #[test]
    fn circles_hold_what_they_say_from_round_to_flat() {
        let known = [
            (1.0, 2.447_747, 1.177_410),
            (0.5, 2.035_859, 0.870_417),
            (0.2, 1.970_408, 0.705_854),
            (0.05, 1.960_603, 0.676_348),
            (0.0, 1.959_964, 0.674_490),
        ];
        for (short, most, half) in known {
            let covariance = Matrix2::new(9.0, 0.0, 0.0, 9.0 * short * short);
            for (probability, radius) in [(0.95, most), (0.5, half)] {
                let found = circle_radius(&covariance, probability) / 3.0;
                assert!((found - radius).abs() < 2e-5, "{short}: {found} {radius}");
            }
        }
    }

    #[test]
    fn a_circle_does_not_turn_and_nothing_is_known_exactly() {
        let tilted = Matrix2::new(5.0, 3.0, 3.0, 5.0);
        let straight = Matrix2::new(8.0, 0.0, 0.0, 2.0);
        let off = circle_radius(&tilted, 0.95) - circle_radius(&straight, 0.95);
        assert!(off.abs() < 1e-12);
        assert_eq!(circle_radius(&Matrix2::zeros(), 0.95), 0.0);
    }
}
