//! Pairs that may be right by themselves.

use nalgebra::{Matrix2, Vector2};
use std::f64::consts::TAU;

use super::{AssociationProblem, AssociationSettings};
use pilotage_base::statistics::chi_square_quantile;

/// Range of logarithms of sizes over which wrong pairs spread.
const SPREAD_OF_LOG_SIZES: f64 = 3.0;
/// Ratio of sizes beyond which a pair is none, in standard deviations of its logarithm.
const SIZE_GATE: f64 = 3.3;

/// A pair that may be right.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    pub observed: usize,
    pub possible: usize,
    /// Error of the believed position, metres north and east (true less believed), if the pair is right and the
    /// attitude exact.
    pub offset: Vector2<f64>,
    /// Covariance of the pair's own error, square metres.
    pub covariance: Matrix2<f64>,
    /// Likelihood of the two sizes in a right pair over that in a wrong one.
    pub size_ratio: f64,
}

/// All pairs of the same class and a fitting size that lie as near each other as the errors of the pose let them.
pub fn candidates(
    problem: &AssociationProblem<'_>,
    settings: &AssociationSettings,
) -> Vec<Candidate> {
    let gate = chi_square_quantile(settings.gate, 2.0);
    let mut found = Vec::new();
    for (i, observed) in problem.observed.iter().enumerate() {
        let by_pose = observed.by_pose * problem.common.pose * observed.by_pose.transpose();
        let shared = problem.common.position + by_pose + observed.covariance;
        for (j, possible) in problem.possible.iter().enumerate() {
            if observed.class != possible.class {
                continue;
            }
            let offset = possible.place - observed.place;
            let Some(weight) = (shared + possible.covariance).try_inverse() else {
                continue;
            };
            if (weight * offset).dot(&offset) > gate {
                continue;
            }
            let log_ratio = (observed.size / possible.size).ln() / settings.log_size;
            if log_ratio.abs() > SIZE_GATE {
                continue;
            }
            let density = (-0.5 * log_ratio * log_ratio).exp() / (TAU.sqrt() * settings.log_size);
            found.push(Candidate {
                observed: i,
                possible: j,
                offset,
                covariance: observed.covariance + possible.covariance,
                size_ratio: density * SPREAD_OF_LOG_SIZES,
            });
        }
    }
    found
}
