//! Probability that a mark is right, given its score.

use serde::{Deserialize, Serialize};

use super::draws::by_day;
use super::isotonic::Isotonic;
use super::rate::{correlation_within, counts_by_day};
use super::{EvaluatedLook, Rate};
use pilotage_vision::landmark::trained::Likelihood;

/// Parts of which each is left out once.
const FOLDS: usize = 5;
/// Bins of the reliability check.
const TENTHS: usize = 10;

/// A mark that is right or wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JudgedMark {
    /// Score.
    pub score: f64,
    /// Whether it is the landmark.
    pub right: bool,
}

/// Probability of being right as a function of the score.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Probability {
    /// 1 / (1 + exp(-(slope score + intercept))): Platt 1999, with his smoothed targets.
    Logistic {
        /// Log odds per unit of score, never negative.
        slope: f64,
        /// Log odds at score 0.
        intercept: f64,
    },
    /// The nearest rising function, of the marks and one wrong mark above all and one right below.
    Isotonic(Isotonic),
}

impl Probability {
    /// Platt's fit. With only right or only wrong marks it is level.
    ///
    /// ```
    /// use pilotage_training::evaluation::{JudgedMark, Probability};
    ///
    /// // One of either kind: Platt's targets are 2/3 and 1/3.
    /// let marks = [(1.0, true), (-1.0, false)].map(|(score, right)| JudgedMark { score, right });
    /// let probability = Probability::logistic(&marks);
    /// assert!((probability.at(0.0) - 0.5).abs() < 1e-6);
    /// assert!((probability.at(1.0) - 2.0 / 3.0).abs() < 1e-6);
    /// ```
    pub fn logistic(marks: &[JudgedMark]) -> Self {
        let judged: Vec<(f64, bool)> = marks.iter().map(|m| (m.score, m.right)).collect();
        let fitted = Likelihood::fit(&judged);
        if fitted.slope > 0.0 {
            return Self::Logistic {
                slope: fitted.slope,
                intercept: fitted.offset,
            };
        }
        // A score that speaks against itself says nothing.
        let right = marks.iter().filter(|m| m.right).count() as f64;
        let wrong = marks.len() as f64 - right;
        Self::Logistic {
            slope: 0.0,
            intercept: ((right + 1.0) / (wrong + 1.0)).ln(),
        }
    }

    /// The nearest rising function.
    pub fn isotonic(marks: &[JudgedMark]) -> Self {
        let scores = marks.iter().map(|m| m.score);
        let low = scores.clone().fold(f64::INFINITY, f64::min);
        let high = scores.fold(f64::NEG_INFINITY, f64::max);
        let sample = |m: &JudgedMark| [m.score, f64::from(u8::from(m.right)), 1.0];
        let mut samples: Vec<_> = marks.iter().map(sample).collect();
        if low <= high {
            samples.extend([[low, 1.0, 1.0], [high, 0.0, 1.0]]);
        }
        Self::Isotonic(Isotonic::rising(&samples))
    }

    /// Probability at a score.
    pub fn at(&self, score: f64) -> f64 {
        match self {
            Self::Logistic { slope, intercept } => logistic(slope * score + intercept),
            Self::Isotonic(function) => function.at(score),
        }
    }
}

fn logistic(x: f64) -> f64 {
    1.0 / (1.0 + (-x).exp())
}

/// Marks of about the same stated probability.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScoreBin {
    /// Mean stated probability.
    pub stated: f64,
    /// Rate of right marks.
    pub right: Rate,
}

/// Probabilities of scores, and whether they come true on days that they were not learned from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScoreCalibration {
    /// The function that is used, learned from all days.
    pub probability: Probability,
    /// Marks that it was learned from, and how many of them are right.
    pub marks: Rate,
    /// Mean log loss of the logistic and of the isotonic function on days left out, nats; the lesser
    /// was chosen.
    pub log_losses: [f64; 2],
    /// Mean squared difference of the stated probability and what came true (Brier 1950), on days left
    /// out.
    pub brier: f64,
    /// The same were the share of right marks stated for each of them.
    pub brier_of_share: f64,
    /// Stated probabilities by tenths of the marks, on days left out.
    pub reliability: Vec<ScoreBin>,
}

impl ScoreCalibration {
    /// Learned from the best right mark of each look and from every wrong one; `None` if there are no
    /// right or no wrong ones.
    pub fn of(looks: &[EvaluatedLook]) -> Option<Self> {
        let marks: Vec<Vec<JudgedMark>> = looks.iter().map(judged).collect();
        let all: Vec<JudgedMark> = marks.iter().flatten().copied().collect();
        let right = all.iter().filter(|m| m.right).count();
        if right == 0 || right == all.len() {
            return None;
        }
        let fold_of = folds(looks);
        let mut stated: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
        let (mut outcomes, mut days) = (Vec::new(), Vec::new());
        for fold in 0..FOLDS {
            let in_fold = |inside: bool| {
                let chosen = marks.iter().zip(&fold_of).zip(looks);
                let chosen = chosen.filter(move |((_, f), _)| (**f == fold) == inside);
                chosen.flat_map(|((marks, _), look)| marks.iter().map(|mark| (*mark, look.day)))
            };
            let rest: Vec<JudgedMark> = in_fold(false).map(|(mark, _)| mark).collect();
            if rest.is_empty() {
                continue;
            }
            let learned = [Probability::logistic(&rest), Probability::isotonic(&rest)];
            for (mark, day) in in_fold(true) {
                outcomes.push(mark.right);
                days.push(day);
                for (stated, learned) in stated.iter_mut().zip(&learned) {
                    stated.push(doubted(learned.at(mark.score), rest.len()));
                }
            }
        }
        let log_losses = [0, 1].map(|i| log_loss(&stated[i], &outcomes));
        let chosen = usize::from(log_losses[1] < log_losses[0]);
        let share = right as f64 / all.len() as f64;
        Some(Self {
            probability: if chosen == 0 {
                Probability::logistic(&all)
            } else {
                Probability::isotonic(&all)
            },
            marks: of_days(
                (marks.iter().zip(looks))
                    .flat_map(|(marks, look)| marks.iter().map(|mark| (look.day, mark.right))),
            ),
            log_losses,
            brier: brier_score(&stated[chosen], &outcomes),
            brier_of_share: share * (1.0 - share),
            reliability: reliability(&stated[chosen], &outcomes, &days),
        })
    }

    /// Probability that a mark of that score is right, among marks of which as large a share is right as
    /// among those it was learned from. Never surer than so many marks can make it.
    pub fn at(&self, score: f64) -> f64 {
        doubted(self.probability.at(score), self.marks.of)
    }

    /// Log of how much likelier the score is of a right mark than of a wrong one. Of detectors that err
    /// independently these add up.
    pub fn log_likelihood_ratio(&self, score: f64) -> f64 {
        let log_odds = |p: f64| p.ln() - (1.0 - p).ln();
        let share = self.marks.share().unwrap_or(0.5);
        log_odds(self.at(score)) - log_odds(share)
    }
}

/// A probability that `marks` marks can support: by Laplace's rule of succession none is nearer to 0 or 1
/// than if all of them had gone one way.
fn doubted(probability: f64, marks: usize) -> f64 {
    let least = 1.0 / (marks as f64 + 2.0);
    probability.clamp(least, 1.0 - least)
}

/// Mean log loss of stated probabilities, nats.
///
/// ```
/// use pilotage_training::evaluation::log_loss;
///
/// // Whoever says one half loses ln 2, whatever comes true.
/// assert!((log_loss(&[0.5, 0.5], &[true, false]) - 2_f64.ln()).abs() < 1e-12);
/// ```
pub fn log_loss(stated: &[f64], came_true: &[bool]) -> f64 {
    let one = |(p, right): (&f64, &bool)| -(if *right { *p } else { 1.0 - p }).max(1e-300).ln();
    let sum: f64 = stated.iter().zip(came_true).map(one).sum();
    sum / stated.len().max(1) as f64
}

/// Mean squared difference of stated probabilities and what came true.
///
/// ```
/// use pilotage_training::evaluation::brier_score;
///
/// assert!((brier_score(&[0.9, 0.2], &[true, false]) - (0.01 + 0.04) / 2.0).abs() < 1e-12);
/// ```
pub fn brier_score(stated: &[f64], came_true: &[bool]) -> f64 {
    let one = |(p, right): (&f64, &bool)| (p - f64::from(u8::from(*right))).powi(2);
    let sum: f64 = stated.iter().zip(came_true).map(one).sum();
    sum / stated.len().max(1) as f64
}

/// The best right mark of a look and every wrong one.
fn judged(look: &EvaluatedLook) -> Vec<JudgedMark> {
    let found = look
        .found_at()
        .map(|score| JudgedMark { score, right: true });
    let wrong = look.wrong_marks().map(|m| JudgedMark {
        score: m.score,
        right: false,
    });
    found.into_iter().chain(wrong).collect()
}

/// Part of each look: whole days, or looks in turn where there are too few days.
fn folds(looks: &[EvaluatedLook]) -> Vec<usize> {
    let days = by_day(looks);
    let mut folds: Vec<usize> = (0..looks.len()).map(|i| i % FOLDS).collect();
    if days.len() >= FOLDS {
        for (number, (_, day)) in days.iter().enumerate() {
            for &look in day {
                folds[look] = number % FOLDS;
            }
        }
    }
    folds
}

/// Rate of right marks, given the day of each and whether it is right: marks of a day go together.
fn of_days(marks: impl Iterator<Item = (usize, bool)>) -> Rate {
    let days = counts_by_day(marks.map(|(day, right)| (day, (right, true))));
    Rate::clustered(&days, correlation_within(&days))
}

/// Stated probabilities in ten groups of equal size; equal ones stay together.
fn reliability(stated: &[f64], came_true: &[bool], days: &[usize]) -> Vec<ScoreBin> {
    let outcomes = days.iter().copied().zip(came_true.iter().copied());
    let mut pairs: Vec<(f64, (usize, bool))> = stated.iter().copied().zip(outcomes).collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut bins = Vec::new();
    let mut begin = 0;
    for tenth in 1..=TENTHS {
        let mut end = (tenth * pairs.len()) / TENTHS;
        while end > begin && end < pairs.len() && pairs[end].0 == pairs[end - 1].0 {
            end += 1;
        }
        let Some(group) = pairs.get(begin..end).filter(|g| !g.is_empty()) else {
            continue;
        };
        begin = end;
        bins.push(ScoreBin {
            stated: group.iter().map(|p| p.0).sum::<f64>() / group.len() as f64,
            right: of_days(group.iter().map(|p| p.1)),
        });
    }
    bins
}

#[cfg(test)]
mod tests {
    use super::super::sample::{SyntheticDetector, look, mark};
    use super::super::wilson;
    use super::*;

    #[test]
    fn normal_scores_are_calibrated_by_the_logistic_function_that_they_follow() {
        // Wrong marks from N(0, 1), right from N(3, 1): log odds 3 s - 4.5 + log(right / wrong).
        let detector = SyntheticDetector {
            day: 0.0,
            ..SyntheticDetector::USUAL
        };
        let calibration = ScoreCalibration::of(&detector.looks(20, 200, 3)).unwrap();
        let Probability::Logistic { slope, .. } = calibration.probability else {
            panic!("{calibration:?}");
        };
        assert!((slope - 3.0).abs() < 0.2, "{slope}");
        for score in [0.5, 1.5, 2.5] {
            let expected = 3.0 * score - 4.5;
            let ratio = calibration.log_likelihood_ratio(score);
            assert!(
                (ratio - expected).abs() < 0.3,
                "{score}: {ratio} {expected}"
            );
        }
        assert!(calibration.brier < 0.4 * calibration.brier_of_share);
        for bin in &calibration.reliability {
            let allowed = bin.right.low - 0.03..=bin.right.high + 0.03;
            assert!(allowed.contains(&bin.stated), "{bin:?}");
        }
        let counted: usize = calibration.reliability.iter().map(|b| b.right.of).sum();
        assert_eq!(counted, calibration.marks.of);
    }

    #[test]
    fn a_step_is_calibrated_by_the_isotonic_function() {
        // Right are nine of ten above 0.2 and one of ten below; beyond it the score says nothing.
        let looks: Vec<_> = (0..1000)
            .map(|i| {
                let score = (i * 37 % 1000) as f64 / 1000.0;
                look(i % 20, &[mark(score, (i * 7 % 10 == 0) != (score > 0.2))])
            })
            .collect();
        let calibration = ScoreCalibration::of(&looks).unwrap();
        assert!(matches!(calibration.probability, Probability::Isotonic(_)));
        assert!((calibration.probability.at(0.9) - 0.9).abs() < 0.05);
        assert!((calibration.probability.at(0.1) - 0.1).abs() < 0.05);
    }

    #[test]
    fn marks_of_a_day_that_all_go_one_way_are_worth_one_try() {
        // On each of 20 days ten marks of one score, which are all right on every second day.
        let looks: Vec<_> = (0..200)
            .map(|i| look(i % 20, &[mark(0.5, i % 2 == 0)]))
            .collect();
        let calibration = ScoreCalibration::of(&looks).unwrap();
        let (low, high) = wilson(10.0, 20.0);
        let all = calibration.marks;
        assert_eq!((all.happened, all.of), (100, 200));
        assert!(
            (all.low - low).abs() < 1e-9 && (all.high - high).abs() < 1e-9,
            "{all:?}"
        );
        let bins = &calibration.reliability;
        let counted: usize = bins.iter().map(|bin| bin.right.of).sum();
        assert_eq!(counted, 200);
        // Forty marks of four days or more are worth no more tries than days.
        assert!(
            bins.iter().all(|bin| bin.right.high - bin.right.low > 0.35),
            "{bins:?}"
        );
    }

    #[test]
    fn no_score_is_certain() {
        let looks: Vec<_> = (0..30)
            .map(|d| look(d, &[mark(0.9, true), mark(0.1, false)]))
            .collect();
        let calibration = ScoreCalibration::of(&looks).unwrap();
        let ratio = calibration.log_likelihood_ratio(5.0);
        assert!(ratio.is_finite() && ratio > 2.0, "{ratio}");
        let both = Probability::isotonic(&judged(&looks[0]));
        assert!(both.at(0.9) < 1.0 && both.at(0.1) > 0.0);
        assert!(ScoreCalibration::of(&looks[..0]).is_none());
    }

    #[test]
    fn a_score_that_speaks_against_itself_says_nothing() {
        let looks: Vec<_> = (0..30)
            .map(|d| look(d, &[mark(0.1, true), mark(0.9, false)]))
            .collect();
        let calibration = ScoreCalibration::of(&looks).unwrap();
        assert!(calibration.log_likelihood_ratio(0.9).abs() < 0.2);
    }
}
