//! Fading factor on a belief's covariance for an innovation that it did not expect.

use nalgebra::{DMatrix, DVector};

/// Halvings of the bracket; its end is exact to a billionth.
const HALVINGS: usize = 60;

/// The factor of at least 1 on the belief's covariance under which an `innovation` (n) is likeliest,
/// where `innovation_covariance` S = H P Hᵀ + R and `noise` R are n × n; `None` unless R is positive
/// definite.
///
/// With R = L Lᵀ, the eigenvalues λ of L⁻¹ (S - R) L⁻ᵀ and the innovation y in its axes, the
/// likelihood Π N(yᵢ; 0, κ λᵢ + 1) is greatest where Σ λᵢ (yᵢ² - κ λᵢ - 1) / (κ λᵢ + 1)² = 0. What the
/// belief does not move (λ = 0) says nothing about it. The factor is the fading factor of Xia, Rao,
/// Ying and Shen (Automatica 30, 1994), found by likelihood instead of by a trace.
pub fn fading_factor(
    innovation: &DVector<f64>,
    innovation_covariance: &DMatrix<f64>,
    noise: &DMatrix<f64>,
) -> Option<f64> {
    let root = noise.clone().cholesky()?.l();
    let half = root.solve_lower_triangular(&(innovation_covariance - noise))?;
    let scaled = root.solve_lower_triangular(&half.transpose())?;
    let axes = (0.5 * (&scaled + scaled.transpose())).symmetric_eigen();
    let along = axes
        .eigenvectors
        .tr_mul(&root.solve_lower_triangular(innovation)?);
    let pairs: Vec<(f64, f64)> = axes
        .eigenvalues
        .iter()
        .zip(along.iter())
        .map(|(lambda, y)| (lambda.max(0.0), y * y))
        .collect();
    let slope = |factor: f64| -> f64 {
        let term = |(lambda, square): &(f64, f64)| {
            let spread = factor * lambda + 1.0;
            lambda * (square - spread) / (spread * spread)
        };
        pairs.iter().map(term).sum()
    };
    // Beyond this no term is positive.
    let beyond = pairs
        .iter()
        .filter(|(lambda, _)| *lambda > 1e-9)
        .map(|(lambda, square)| (square - 1.0) / lambda)
        .fold(1.0, f64::max);
    if !beyond.is_finite() {
        return None;
    }
    if slope(1.0) <= 0.0 {
        return Some(1.0);
    }
    let (mut low, mut high) = (1.0, beyond);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if slope(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn along_one_axis_the_innovation_becomes_one_deviation() {
        let (p, r, y) = (4.0, 1.0, 12.0);
        let innovation = DVector::from_element(1, y);
        let s = DMatrix::from_element(1, 1, p + r);
        let noise = DMatrix::from_element(1, 1, r);
        let factor = fading_factor(&innovation, &s, &noise).unwrap();
        assert!((factor * p + r - y * y).abs() < 1e-6, "{factor}");
    }

    #[test]
    fn an_expected_innovation_changes_nothing() {
        let innovation = DVector::from_column_slice(&[1.0, -1.0]);
        let s = DMatrix::identity(2, 2) * 3.0;
        let factor = fading_factor(&innovation, &s, &DMatrix::identity(2, 2));
        assert_eq!(factor, Some(1.0));
    }

    #[test]
    fn what_the_belief_does_not_move_is_no_reason_to_doubt_it() {
        let s = DMatrix::from_diagonal(&DVector::from_column_slice(&[5.0, 1.0]));
        let noise = DMatrix::identity(2, 2);
        let odd_turn = DVector::from_column_slice(&[1.0, 30.0]);
        assert_eq!(fading_factor(&odd_turn, &s, &noise), Some(1.0));
    }

    #[test]
    fn no_other_factor_is_likelier() {
        let prior = DMatrix::from_row_slice(2, 2, &[6.0, 2.5, 2.5, 3.0]);
        let noise = DMatrix::from_row_slice(2, 2, &[1.5, -0.4, -0.4, 0.8]);
        let innovation = DVector::from_column_slice(&[14.0, -3.0]);
        let log_likelihood = |factor: f64| {
            let root = (&prior * factor + &noise).cholesky().unwrap();
            let nis = root.solve(&innovation).dot(&innovation);
            -0.5 * (root.determinant().ln() + nis)
        };
        let factor = fading_factor(&innovation, &(&prior + &noise), &noise).unwrap();
        assert!(factor > 1.0);
        for other in [0.5, 0.9, 0.99, 1.01, 1.1, 2.0] {
            assert!(
                log_likelihood(factor) > log_likelihood(factor * other),
                "{other}"
            );
        }
    }
}
