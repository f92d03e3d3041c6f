//! The unscented transform of a small example: a bearing and a range become a place.

use nalgebra::{Matrix2, Vector2};

/// Range, and its standard deviation.
const RANGE: (f64, f64) = (1.0, 0.03);
/// Standard deviation of the bearing, radians.
const BEARING_SIGMA: f64 = 0.42;
/// Weight of the centre for Gaussians, eq 12.
const BETA: f64 = 2.0;

/// Result of the transform for the example.
pub(crate) struct Transformed {
    /// The sigma points after the curve, centre first.
    pub points: Vec<Vector2<f64>>,
    /// Their weighted mean.
    pub mean: Vector2<f64>,
    /// Their weighted covariance.
    pub covariance: Matrix2<f64>,
}

/// The curve: (range, bearing) to (right, up).
pub(crate) fn place(range: f64, bearing: f64) -> Vector2<f64> {
    Vector2::new(range * bearing.sin(), range * bearing.cos())
}

/// The example through the unscented transform with spread α.
///
/// DeAngelo 2016, eqs 9-15, with N = 2: η = α √N, outer weights 1 / (2 N α²).
pub(crate) fn transform(alpha: f64) -> Transformed {
    let eta = alpha * 2.0_f64.sqrt();
    let outer = 1.0 / (4.0 * alpha * alpha);
    let center_mean = 1.0 - 1.0 / (alpha * alpha);
    let center_covariance = center_mean + 1.0 - alpha * alpha + BETA;
    let (range, range_sigma) = RANGE;
    let points = vec![
        place(range, 0.0),
        place(range + eta * range_sigma, 0.0),
        place(range, eta * BEARING_SIGMA),
        place(range - eta * range_sigma, 0.0),
        place(range, -eta * BEARING_SIGMA),
    ];
    let outer_sum: Vector2<f64> = points[1..].iter().sum();
    let mean = points[0] * center_mean + outer_sum * outer;
    let spread = |p: &Vector2<f64>, weight: f64| (p - mean) * (p - mean).transpose() * weight;
    let covariance = points[1..]
        .iter()
        .fold(spread(&points[0], center_covariance), |sum, p| {
            sum + spread(p, outer)
        });
    Transformed {
        points,
        mean,
        covariance,
    }
}

/// The true mean: E[cos θ] = exp(-σ²/2) for a Gaussian bearing.
pub(crate) fn true_mean() -> Vector2<f64> {
    Vector2::new(0.0, RANGE.0 * (-0.5 * BEARING_SIGMA * BEARING_SIGMA).exp())
}

/// Places of a cloud of equally likely ranges and bearings, for drawing.
pub(crate) fn cloud() -> impl Iterator<Item = Vector2<f64>> {
    // The additive recurrence of the golden ratio's plane cousin fills the unit square evenly;
    // Box-Muller bends it into a Gaussian.
    (1..=400).map(|i| {
        let i = f64::from(i);
        let (u, v) = ((0.754_877_666 * i).fract(), (0.569_840_291 * i).fract());
        let radius = (-2.0 * u.max(1e-9).ln()).sqrt();
        let angle = std::f64::consts::TAU * v;
        place(
            RANGE.0 + RANGE.1 * radius * angle.cos(),
            BEARING_SIGMA * radius * angle.sin(),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn for_every_alpha_the_mean_is_nearer_the_truth_than_the_linear_one() {
        for alpha in [0.01, 0.1, 0.5, 1.0] {
            let error = (transform(alpha).mean - true_mean()).norm();
            let linear = (place(RANGE.0, 0.0) - true_mean()).norm();
            assert!(error < 0.2 * linear, "{alpha}: {error} {linear}");
        }
    }

    #[test]
    fn the_cloud_s_mean_is_the_true_mean() {
        let sum: Vector2<f64> = cloud().sum();
        assert!((sum / 400.0 - true_mean()).norm() < 0.01);
    }

    #[test]
    fn a_smaller_alpha_draws_the_points_together() {
        let reach = |alpha: f64| {
            let t = transform(alpha);
            (t.points[2] - t.points[0]).norm()
        };
        assert!(reach(0.1) < 0.2 * reach(1.0));
    }
}
