//! Likelihood that a mark is the landmark, by its score.

use serde::{Deserialize, Serialize};

/// Newton steps of a fit at most; it converges in five or so.
const STEPS: usize = 60;
/// Lengths of a step that are tried, each half of the one before, until nothing is better.
const HALVINGS: i32 = 27;

/// Log odds of being right as a line over the score (Platt 1999), fitted to marks whose truth is known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Likelihood {
    /// Log odds at a score of zero.
    pub offset: f64,
    /// Log odds per unit of the score.
    pub slope: f64,
}

impl Likelihood {
    /// Fits marks: their score, and whether they are right. Targets are drawn in by a half sample on
    /// either side (Platt's prior), so that scores that part the two for good do not lead to certainty.
    ///
    /// ```
    /// use pilotage_vision::landmark::trained::Likelihood;
    ///
    /// // One right and one wrong mark: Platt's targets are 2/3 and 1/3, odds of 2 and 1/2.
    /// let likelihood = Likelihood::fit(&[(1.0, true), (-1.0, false)]);
    /// assert!((likelihood.probability(0.0) - 0.5).abs() < 1e-6);
    /// assert!((likelihood.log_odds(1.0) - 2_f64.ln()).abs() < 1e-6);
    /// ```
    pub fn fit(marks: &[(f64, bool)]) -> Self {
        let n = marks.len().max(1) as f64;
        let right = marks.iter().filter(|m| m.1).count() as f64;
        let wrong = marks.len() as f64 - right;
        let targets = [1.0 / (wrong + 2.0), (right + 1.0) / (right + 2.0)];
        let mean = marks.iter().map(|m| m.0).sum::<f64>() / n;
        let variance = marks.iter().map(|m| (m.0 - mean).powi(2)).sum::<f64>() / n;
        let spread = if variance > 0.0 { variance.sqrt() } else { 1.0 };
        let samples: Vec<[f64; 2]> = marks
            .iter()
            .map(|(score, is_right)| [(score - mean) / spread, targets[usize::from(*is_right)]])
            .collect();
        let level = Self {
            offset: ((right + 1.0) / (wrong + 1.0)).ln(),
            slope: 0.0,
        };
        let Self { offset, slope } = likeliest(&samples, level);
        Self {
            offset: offset - slope * mean / spread,
            slope: slope / spread,
        }
    }

    /// Logarithm of the odds that a mark of that score is right.
    pub fn log_odds(&self, score: f64) -> f64 {
        self.offset + self.slope * score
    }

    /// Probability that a mark of that score is right.
    pub fn probability(&self, score: f64) -> f64 {
        1.0 / (1.0 + (-self.log_odds(score)).exp())
    }
}

/// Maximum likelihood of samples (score, share of right ones), by damped Newton steps.
fn likeliest(samples: &[[f64; 2]], mut line: Likelihood) -> Likelihood {
    let loss = |line: &Likelihood| -> f64 {
        let of = |&[score, target]: &[f64; 2]| {
            let z = line.log_odds(score);
            // Cross entropy, in the form that never overflows.
            z.max(0.0) - z * target + (-z.abs()).exp().ln_1p()
        };
        samples.iter().map(of).sum()
    };
    let mut least = loss(&line);
    for _ in 0..STEPS {
        let (mut g, mut h) = ([0.0; 2], [1e-9, 0.0, 1e-9]);
        for &[score, target] in samples {
            let p = line.probability(score);
            let (d, w) = (p - target, p * (1.0 - p));
            g = [g[0] + d, g[1] + d * score];
            h = [h[0] + w, h[1] + w * score, h[2] + w * score * score];
        }
        let det = h[0] * h[2] - h[1] * h[1];
        let step = [
            (h[2] * g[0] - h[1] * g[1]) / det,
            (h[0] * g[1] - h[1] * g[0]) / det,
        ];
        // Half as far until it is better.
        let better = (0..HALVINGS).map(|i| 0.5_f64.powi(i)).find_map(|share| {
            let next = Likelihood {
                offset: line.offset - share * step[0],
                slope: line.slope - share * step[1],
            };
            let new = loss(&next);
            (new < least).then_some((next, new))
        });
        let Some((next, new)) = better else {
            break;
        };
        let gain = least - new;
        (line, least) = (next, new);
        if gain < 1e-13 * least.abs() {
            break;
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt as _, SeedableRng as _};
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn marks_drawn_from_a_line_of_log_odds_give_it_back() {
        let truth = Likelihood {
            offset: -1.5,
            slope: 0.8,
        };
        let mut random = ChaCha8Rng::seed_from_u64(9);
        let marks: Vec<(f64, bool)> = (0..20_000)
            .map(|_| {
                let score = 8.0 * random.random::<f64>() - 2.0;
                (score, random.random::<f64>() < truth.probability(score))
            })
            .collect();
        let found = Likelihood::fit(&marks);
        assert!((found.offset - truth.offset).abs() < 0.1, "{found:?}");
        assert!((found.slope - truth.slope).abs() < 0.05, "{found:?}");
    }

    #[test]
    fn few_marks_that_a_score_parts_for_good_make_nobody_certain() {
        let marks: Vec<(f64, bool)> = (0..20).map(|i| (f64::from(i), i >= 10)).collect();
        let found = Likelihood::fit(&marks);
        let sure = found.probability(19.0);
        assert!(sure > 0.85 && sure < 0.99, "{sure}");
        assert!(found.probability(0.0) < 0.15);
    }
}
