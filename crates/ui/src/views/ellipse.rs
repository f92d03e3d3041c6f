//! Ellipses of two-dimensional covariances.

use nalgebra::{Matrix2, Vector2};

/// Points on the ellipse {v : vᵀ C⁻¹ v = `squared_radius`} around zero, closed, in C's axes.
///
/// With C = V diag(λ) Vᵀ they are V √(λ · `squared_radius`) (cos φ, sin φ).
pub(crate) fn outline(
    covariance: &Matrix2<f64>,
    squared_radius: f64,
    segments: usize,
) -> Vec<Vector2<f64>> {
    let symmetric = (covariance + covariance.transpose()) * 0.5;
    let eigen = symmetric.symmetric_eigen();
    let axes = eigen
        .eigenvalues
        .map(|v| (v.max(0.0) * squared_radius).sqrt());
    (0..=segments)
        .map(|i| {
            let angle = std::f64::consts::TAU * i as f64 / segments as f64;
            eigen.eigenvectors * Vector2::new(axes.x * angle.cos(), axes.y * angle.sin())
        })
        .collect()
}

/// Greatest standard deviation over all directions: √ of the larger eigenvalue.
pub(crate) fn largest_sigma(covariance: &Matrix2<f64>) -> f64 {
    let half_trace = 0.5 * covariance.trace();
    let half_difference = 0.5 * (covariance[(0, 0)] - covariance[(1, 1)]);
    let larger =
        half_trace + half_difference.hypot(0.5 * (covariance[(0, 1)] + covariance[(1, 0)]));
    larger.max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_of_an_outline_has_the_asked_mahalanobis_distance() {
        let covariance = Matrix2::new(4.0, 1.5, 1.5, 2.0);
        let inverse = covariance.try_inverse().unwrap();
        for point in outline(&covariance, 9.0, 40) {
            assert!(((point.transpose() * inverse * point)[0] - 9.0).abs() < 1e-9);
        }
    }

    #[test]
    fn the_largest_sigma_is_the_outline_s_farthest_reach() {
        let covariance = Matrix2::new(4.0, 1.5, 1.5, 2.0);
        let reach = outline(&covariance, 1.0, 3600)
            .iter()
            .fold(0.0, |most: f64, p| most.max(p.norm()));
        assert!((reach - largest_sigma(&covariance)).abs() < 1e-5);
    }
}
