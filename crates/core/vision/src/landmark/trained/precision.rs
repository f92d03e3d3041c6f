//! Precision of a mark in place, turn and size, learned where the truth is known.

use nalgebra::{Matrix2, Matrix4, Vector2, Vector4};
use serde::{Deserialize, Serialize};

use super::Mark;
use crate::landmark::detector::{UNKNOWN_LOG_SCALE, UNKNOWN_TURN};

/// Standard errors that the slope of a reading has to be above zero.
const SIGNIFICANT: f64 = 4.0;

/// Covariance of the right marks of about one score.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScoreScale {
    /// Median score.
    pub score: f64,
    /// Marks of about this score.
    pub marks: usize,
    /// Their covariance is this many times that of all.
    pub scale: f64,
}

/// Dependence of the covariance of right marks on their score: by ascending score, empty where there is none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ByScore(pub Vec<ScoreScale>);

impl ByScore {
    /// Ratio of the covariance of a mark with that score to the covariance of all: straight between the
    /// scores that are known, beyond them as at the last.
    pub fn at(&self, score: f64) -> f64 {
        let after = self.0.partition_point(|s| s.score < score);
        match (
            after.checked_sub(1).map(|i| self.0[i]),
            self.0.get(after).copied(),
        ) {
            (Some(a), Some(b)) => {
                let share = (score - a.score) / (b.score - a.score);
                a.scale + share * (b.scale - a.scale)
            }
            (Some(one), None) | (None, Some(one)) => one.scale,
            (None, None) => 1.0,
        }
    }
}

/// Estimate of what is read from a reading.
///
/// A mark has the turn of the variant in which it was found, which follows the true turn by steps and
/// only as far as the cascade tells turns apart: reading = slope × truth + error. Truth is then estimated
/// by reading / slope, with the variance of error / slope; a reading that does not follow says nothing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReadingEstimate {
    /// The estimate per unit of the reading.
    pub factor: f64,
    /// Variance of the estimate, in the square of its unit.
    pub variance: f64,
}

impl ReadingEstimate {
    /// Learned from pairs of truth and reading, both zero on average; `None` where the reading does not
    /// follow the truth for certain.
    pub fn learned(pairs: &[(f64, f64)]) -> Option<Self> {
        let sum = |f: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>();
        let squares = sum(&|p| p.0 * p.0);
        if squares <= 0.0 || pairs.len() < 10 {
            return None;
        }
        let slope = sum(&|p| p.0 * p.1) / squares;
        let left = sum(&|p| (p.1 - slope * p.0).powi(2)) / (pairs.len() as f64 - 1.0);
        let error = (left / squares).sqrt();
        (slope > SIGNIFICANT * error).then(|| Self {
            factor: 1.0 / slope,
            variance: left / (slope * slope),
        })
    }
}

/// Precision of right marks in place, turn and size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MarkPrecision {
    /// Mean offset of the marks from the landmark (north, east), metres.
    pub bias: Vector2<f64>,
    /// Covariance of their places around that (north, east), m².
    pub covariance: Matrix2<f64>,
    /// Dependence of the covariance on the score.
    pub by_score: ByScore,
    /// Estimate of the ground's turn from the turn of a mark, if it tells anything.
    pub turn: Option<ReadingEstimate>,
    /// The same of the logarithm of the size.
    pub log_scale: Option<ReadingEstimate>,
}

impl MarkPrecision {
    /// Of marks that lie around the landmark with a standard deviation in metres per axis, whatever their
    /// score, and say nothing of turn and size.
    pub fn even(deviation: f64) -> Self {
        Self {
            bias: Vector2::zeros(),
            covariance: Matrix2::from_diagonal_element(deviation * deviation),
            by_score: ByScore::default(),
            turn: None,
            log_scale: None,
        }
    }

    /// Turn (radians) and logarithm of the size of the ground next to the map, zero where marks do not
    /// say, and the covariance of (north, east, turn, logarithm of the size), metres and radians.
    pub fn of(&self, mark: &Mark) -> ([f64; 2], Matrix4<f64>) {
        let read = |reading: Option<ReadingEstimate>, read: f64, unknown: f64| {
            let unknown = unknown * unknown;
            reading.map_or((0.0, unknown), |r| {
                (r.factor * read, r.variance.min(unknown))
            })
        };
        let turn = read(self.turn, mark.rotation, UNKNOWN_TURN);
        let size = read(self.log_scale, mark.log_scale, UNKNOWN_LOG_SCALE);
        let mut covariance = Matrix4::from_diagonal(&Vector4::new(0.0, 0.0, turn.1, size.1));
        covariance
            .fixed_view_mut::<2, 2>(0, 0)
            .copy_from(&(self.covariance * self.by_score.at(mark.score)));
        ([turn.0, size.0], covariance)
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_distr::StandardNormal;

    use super::super::Steps;
    use super::*;

    #[test]
    fn a_reading_by_steps_is_as_good_as_the_steps_are_fine() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(3);
        let steps = Steps::covering(0.3, 0.05);
        let pairs: Vec<(f64, f64)> = (0..500)
            .map(|_| {
                let truth = 0.6 * random.random::<f64>() - 0.3;
                (truth, steps.nearest(truth))
            })
            .collect();
        let reading = ReadingEstimate::learned(&pairs).unwrap();
        // Rounding takes from the slope what it has of the square of the range: 1 / 6².
        assert!(
            (1.0 / reading.factor - 35.0 / 36.0).abs() < 0.01,
            "{reading:?}"
        );
        let usual = steps.step.powi(2) / 12.0;
        assert!((reading.variance / usual - 1.0).abs() < 0.15, "{reading:?}");
    }

    #[test]
    fn what_follows_half_way_counts_twice_and_what_does_not_follow_says_nothing() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(4);
        let mut pairs = |slope: f64| -> Vec<(f64, f64)> {
            (0..400)
                .map(|_| {
                    let mut normal = || random.sample::<f64, _>(StandardNormal);
                    let truth = 0.2 * normal();
                    (truth, slope * truth + 0.05 * normal())
                })
                .collect()
        };
        let half = ReadingEstimate::learned(&pairs(0.5)).unwrap();
        assert!((half.factor - 2.0).abs() < 0.15, "{half:?}");
        assert!((half.variance.sqrt() - 0.1).abs() < 0.01, "{half:?}");
        assert_eq!(ReadingEstimate::learned(&pairs(0.0)), None);
        assert_eq!(ReadingEstimate::learned(&[(0.1, 0.1); 5]), None);
    }

    #[test]
    fn between_known_scores_the_covariance_changes_evenly() {
        let scale = |score: f64, scale: f64| ScoreScale {
            score,
            marks: 30,
            scale,
        };
        let by = ByScore(vec![scale(1.0, 4.0), scale(3.0, 1.0)]);
        for (score, expected) in [(0.0, 4.0), (1.0, 4.0), (2.0, 2.5), (3.0, 1.0), (9.0, 1.0)] {
            assert!((by.at(score) - expected).abs() < 1e-12);
        }
        assert_eq!(ByScore::default().at(2.0), 1.0);
    }
}
