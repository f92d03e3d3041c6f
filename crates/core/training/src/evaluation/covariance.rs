//! Covariance of right marks about the place of the landmark.

use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize};

use super::EvaluatedLook;
use super::isotonic::Isotonic;
use super::robust::RobustFit;
use pilotage_base::statistics::chi_square_quantile;
use pilotage_vision::landmark::trained::{ByScore, ScoreScale};

/// Fewest marks of a group by score.
const FEWEST: usize = 25;
/// Most groups by score.
const MOST_GROUPS: usize = 5;
/// Number of its standard deviations by which a rank correlation has to be below zero.
const SIGNIFICANT: f64 = 2.33;

/// The measurement covariance that a detector's right marks have.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MarkCovariance {
    /// Right marks that it was learned from.
    pub marks: usize,
    /// Those that are no outliers.
    pub used: usize,
    /// Mean offset (north, east), metres: marks lie this far beside the landmark.
    pub bias: [f64; 2],
    /// Covariance (north, east) around the mean, square metres, by the minimum covariance determinant.
    pub covariance: Matrix2<f64>,
    /// Share of the marks inside its 95 % ellipse.
    pub inside_95: f64,
    /// Rank correlation of the score with the distance from the mean: below zero if better scores lie
    /// nearer.
    pub rank_correlation: f64,
    /// By ascending score, where better scores lie nearer by more than chance; otherwise empty.
    pub by_score: ByScore,
}

impl MarkCovariance {
    /// Learned from the best right mark of each look if its score is at least `threshold`. `None` for
    /// under ten marks, or where over half of them lie on a line.
    pub fn of(looks: &[EvaluatedLook], threshold: f64, seed: u64) -> Option<Self> {
        let best = looks.iter().filter_map(EvaluatedLook::best_right);
        let marks: Vec<(f64, Vector2<f64>)> = best
            .filter(|mark| mark.score >= threshold)
            .map(|mark| (mark.score, mark.offset.into()))
            .collect();
        let points: Vec<_> = marks.iter().map(|m| m.1).collect();
        let fit = RobustFit::of(&points, seed)?;
        let inverse = fit.covariance.try_inverse()?;
        let mut scored: Vec<[f64; 2]> = (marks.iter())
            .map(|(score, at)| [*score, (at - fit.mean).dot(&(inverse * (at - fit.mean)))])
            .collect();
        scored.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let limit = chi_square_quantile(0.95, 2.0);
        let inside = scored.iter().filter(|s| s[1] <= limit).count();
        let rank_correlation = rank_correlation(&scored);
        let certain = rank_correlation * (marks.len() as f64 - 1.0).sqrt() < -SIGNIFICANT;
        Some(Self {
            marks: marks.len(),
            used: fit.used,
            bias: fit.mean.into(),
            covariance: fit.covariance,
            inside_95: inside as f64 / marks.len() as f64,
            rank_correlation,
            by_score: ByScore(if certain { scales(&scored) } else { Vec::new() }),
        })
    }

    /// Covariance (north, east) of a mark of that score, square metres.
    pub fn at(&self, score: f64) -> Matrix2<f64> {
        self.covariance * self.by_score.at(score)
    }

    /// Standard deviations along the longer and the shorter axis, metres, and the heading of the longer
    /// one, radians clockwise from north in [0, π).
    pub fn axes(&self) -> [f64; 3] {
        let c = &self.covariance;
        let (mean, half) = (0.5 * c.trace(), 0.5 * (c[(0, 0)] - c[(1, 1)]));
        let away = half.hypot(c[(0, 1)]);
        let heading = 0.5 * c[(0, 1)].atan2(half);
        [
            (mean + away).max(0.0).sqrt(),
            (mean - away).max(0.0).sqrt(),
            heading.rem_euclid(std::f64::consts::PI),
        ]
    }
}

/// Groups of equal size by score: the median squared distance over that of a normal variable, made to
/// fall with the score.
fn scales(scored: &[[f64; 2]]) -> Vec<ScoreScale> {
    let groups = (scored.len() / FEWEST).min(MOST_GROUPS);
    let usual = chi_square_quantile(0.5, 2.0);
    let mut scales: Vec<ScoreScale> = (0..groups)
        .map(|i| {
            let group = &scored[i * scored.len() / groups..(i + 1) * scored.len() / groups];
            let mut distances: Vec<f64> = group.iter().map(|s| s[1]).collect();
            distances.sort_by(f64::total_cmp);
            ScoreScale {
                score: group[group.len() / 2][0],
                marks: group.len(),
                scale: distances[distances.len() / 2] / usual,
            }
        })
        .collect();
    let falling = scales.iter().map(|s| [s.score, -s.scale, s.marks as f64]);
    let falling = Isotonic::rising(&falling.collect::<Vec<_>>());
    for scale in &mut scales {
        scale.scale = -falling.at(scale.score);
    }
    scales
}

/// Spearman's rank correlation of pairs that are sorted by their first.
fn rank_correlation(sorted: &[[f64; 2]]) -> f64 {
    let firsts = ranks(&sorted.iter().map(|s| s[0]).collect::<Vec<_>>());
    let seconds = ranks(&sorted.iter().map(|s| s[1]).collect::<Vec<_>>());
    let middle = 0.5 * (sorted.len() as f64 - 1.0);
    let sum = |f: &dyn Fn(usize) -> f64| (0..sorted.len()).map(f).sum::<f64>();
    let product = sum(&|i| (firsts[i] - middle) * (seconds[i] - middle));
    let squares = [&firsts, &seconds].map(|ranks| sum(&|i| (ranks[i] - middle).powi(2)));
    let norm = (squares[0] * squares[1]).sqrt();
    if norm > 0.0 { product / norm } else { 0.0 }
}

/// Place of each value among all, from 0; equal ones share the mean of their places.
fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let mut ranks = vec![0.0; values.len()];
    for equal in order.chunk_by(|a, b| values[*a] == values[*b]) {
        let below = values.iter().filter(|v| **v < values[equal[0]]).count();
        let rank = below as f64 + 0.5 * (equal.len() - 1) as f64;
        for &i in equal {
            ranks[i] = rank;
        }
    }
    ranks
}

#[cfg(test)]
mod tests {
    use super::super::sample::{SyntheticDetector, look};
    use super::super::{EvaluatedLook, EvaluatedMark};
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_distr::StandardNormal;

    /// Looks of which marks with score s in (0, 1) lie `deviation(s)` metres away.
    fn looks(count: usize, deviation: impl Fn(f64) -> f64) -> Vec<EvaluatedLook> {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(6);
        (0..count)
            .map(|i| {
                let score = random.random::<f64>();
                let mut draw = || deviation(score) * random.sample::<f64, _>(StandardNormal);
                let offset = [draw(), 0.5 * draw()];
                look(
                    i % 10,
                    &[EvaluatedMark {
                        score,
                        offset,
                        right: true,
                        rotation: 0.0,
                        log_scale: 0.0,
                    }],
                )
            })
            .collect()
    }

    #[test]
    fn the_covariance_and_the_bias_of_the_made_up_detector_come_back() {
        let looks = SyntheticDetector::USUAL.looks(20, 100, 8);
        let learned = MarkCovariance::of(&looks, f64::NEG_INFINITY, 1).unwrap();
        assert!((learned.covariance[(0, 0)].sqrt() - 0.8).abs() < 0.04);
        assert!((learned.covariance[(1, 1)].sqrt() - 0.5).abs() < 0.03);
        assert!((learned.bias[0] - 0.3).abs() < 0.06 && (learned.bias[1] + 0.2).abs() < 0.04);
        assert!((learned.inside_95 - 0.95).abs() < 0.015);
        let [longer, shorter, heading] = learned.axes();
        assert!(longer > shorter && heading.sin().abs() < 0.1);
        // There the score says nothing of the distance.
        assert!(learned.by_score.0.is_empty(), "{learned:?}");
        assert_eq!(learned.at(0.2), learned.covariance);
    }

    #[test]
    fn where_better_scores_lie_nearer_the_covariance_falls_with_the_score() {
        let looks = looks(1000, |score| 1.5 - score);
        let learned = MarkCovariance::of(&looks, 0.0, 1).unwrap();
        assert!(learned.rank_correlation < -0.3);
        assert_eq!(learned.by_score.0.len(), 5);
        for score in [0.1, 0.5, 0.9] {
            let deviation = learned.at(score)[(0, 0)].sqrt();
            assert!(
                (deviation - (1.5 - score)).abs() < 0.2,
                "{score}: {deviation}"
            );
        }
        assert!(learned.at(0.0).trace() >= learned.at(1.0).trace());
    }

    #[test]
    fn marks_below_the_threshold_are_not_learned_from() {
        let looks = looks(400, |score| if score < 0.5 { 9.0 } else { 1.0 });
        let learned = MarkCovariance::of(&looks, 0.5, 1).unwrap();
        assert!(learned.covariance[(0, 0)] < 1.3, "{learned:?}");
        assert!(MarkCovariance::of(&looks, 0.99, 1).is_none());
    }
}
