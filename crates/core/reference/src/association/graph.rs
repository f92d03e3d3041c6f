//! The graph of pairs that agree with each other.

use nalgebra::Matrix2x4;
use std::collections::BTreeMap;

use super::candidates::Candidate;
use super::{AssociationProblem, AssociationSettings};
use pilotage_base::statistics::chi_square_quantile;

/// Agreement of each two pairs: 1 if exact, 0 if none. Pairs that share a landmark do not agree.
pub struct AgreementGraph {
    /// For each pair those that agree with it, by number, and how well.
    pub neighbours: Vec<Vec<(u32, f32)>>,
}

impl AgreementGraph {
    /// The graph of `candidates`.
    ///
    /// Two right pairs give the same error of the believed position but for their own errors and for what errors of
    /// the attitude do to one and not to the other. So pairs are sorted by that offset into squares as wide as the
    /// largest difference, and compared with the ones around.
    pub fn of(
        problem: &AssociationProblem<'_>,
        candidates: &[Candidate],
        settings: &AssociationSettings,
    ) -> Self {
        let gate = chi_square_quantile(settings.gate, 2.0);
        let mut neighbours = vec![Vec::new(); candidates.len()];
        let width = (gate * widest(problem, candidates)).sqrt().max(1e-3);
        let mut squares: BTreeMap<(i64, i64), Vec<u32>> = BTreeMap::new();
        let square = |candidate: &Candidate| {
            let along = |metres: f64| (metres / width).floor() as i64;
            (along(candidate.offset.x), along(candidate.offset.y))
        };
        for (index, candidate) in candidates.iter().enumerate() {
            squares
                .entry(square(candidate))
                .or_default()
                .push(index as u32);
        }
        let pose = &problem.common.pose;
        let mut compare = |first: u32, second: u32| {
            let (a, b) = (&candidates[first as usize], &candidates[second as usize]);
            if a.observed == b.observed || a.possible == b.possible {
                return;
            }
            let difference = a.offset - b.offset;
            if difference.norm_squared() > width * width {
                return;
            }
            let by_pose: Matrix2x4<f64> =
                problem.observed[a.observed].by_pose - problem.observed[b.observed].by_pose;
            let covariance = a.covariance + b.covariance + by_pose * pose * by_pose.transpose();
            let determinant = covariance.determinant();
            if determinant <= 0.0 {
                return;
            }
            let (x, y) = (difference.x, difference.y);
            let squared = (covariance[(1, 1)] * x * x - 2.0 * covariance[(0, 1)] * x * y
                + covariance[(0, 0)] * y * y)
                / determinant;
            if squared <= gate {
                let agreement = (-0.5 * squared / 2.0).exp() as f32;
                neighbours[first as usize].push((second, agreement));
                neighbours[second as usize].push((first, agreement));
            }
        };
        for (&(row, column), own) in &squares {
            for (k, &first) in own.iter().enumerate() {
                for &second in &own[k + 1..] {
                    compare(first, second);
                }
            }
            for beside in [(0, 1), (1, -1), (1, 0), (1, 1)] {
                let Some(others) = squares.get(&(row + beside.0, column + beside.1)) else {
                    continue;
                };
                for &first in own {
                    for &second in others {
                        compare(first, second);
                    }
                }
            }
        }
        Self { neighbours }
    }
}

/// Largest variance of a difference of two offsets along any direction, square metres.
fn widest(problem: &AssociationProblem<'_>, candidates: &[Candidate]) -> f64 {
    let count = problem.observed.len().max(1) as f64;
    let sum: Matrix2x4<f64> = problem.observed.iter().map(|o| o.by_pose).sum();
    let middle = sum / count;
    let by_pose = problem.observed.iter().map(|observed| {
        let apart = observed.by_pose - middle;
        (apart * problem.common.pose * apart.transpose()).trace()
    });
    let own = candidates.iter().map(|c| c.covariance.trace());
    // A difference of two vectors has at most four times the larger one's square, of two independent ones twice.
    4.0 * by_pose.fold(0.0, f64::max) + 2.0 * own.fold(0.0, f64::max)
}
