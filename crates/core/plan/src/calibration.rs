//! Calibration of what is said of detections: predicted probabilities beside observed shares.

use std::fmt::Write;

use serde::{Deserialize, Serialize};

/// Bins between 0 and 1.
const BINS: usize = 10;

/// Pass over a landmark: what was said of it, and how it went.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pass {
    /// Predicted probability of being found in a frame.
    pub predicted: f64,
    /// Frames in which the landmark lay whole in the picture.
    pub frames: usize,
    /// Those in which it was found.
    pub found: usize,
    /// Those in which a wrong place was accepted.
    pub wrong: usize,
}

/// Passes of about the same predicted probability.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ReliabilityBin {
    /// Passes in it.
    pub passes: usize,
    /// Frames in it.
    pub frames: usize,
    /// Mean predicted probability of its frames.
    pub predicted: f64,
    /// Share of its frames in which the landmark was found.
    pub observed: f64,
    /// Standard deviation of that share; frames of a pass go together.
    pub uncertainty: f64,
}

/// Predicted probabilities beside observed shares, by tenths.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reliability {
    /// From 0 to 1.
    pub bins: Vec<ReliabilityBin>,
    /// Share of all frames in which a wrong place was accepted.
    pub false_matches: f64,
}

impl Reliability {
    /// Sums passes up.
    ///
    /// ```
    /// use pilotage_plan::{Pass, Reliability};
    ///
    /// // Said to be found in 80 % of the frames, found in 6 of 10.
    /// let pass = Pass { predicted: 0.8, frames: 10, found: 6, wrong: 1 };
    /// let reliability = Reliability::of(&[pass, pass]);
    /// assert!((reliability.largest_difference(2) - 0.2).abs() < 1e-12);
    /// assert!((reliability.false_matches - 0.1).abs() < 1e-12);
    /// ```
    pub fn of(passes: &[Pass]) -> Self {
        let tenth = |p: &Pass| ((p.predicted * BINS as f64) as usize).min(BINS - 1);
        let bins = (0..BINS).map(|bin| {
            let inside: Vec<&Pass> = passes.iter().filter(|p| tenth(p) == bin).collect();
            summed(&inside)
        });
        let sum = |f: fn(&Pass) -> usize| passes.iter().map(f).sum::<usize>() as f64;
        Self {
            bins: bins.collect(),
            false_matches: sum(|p| p.wrong) / sum(|p| p.frames).max(1.0),
        }
    }

    /// Largest difference between predicted and observed over bins of at least `passes` passes.
    pub fn largest_difference(&self, passes: usize) -> f64 {
        let filled = self.bins.iter().filter(|b| b.passes >= passes.max(1));
        filled
            .map(|b| (b.predicted - b.observed).abs())
            .fold(0.0, f64::max)
    }

    /// The reliability diagram as a picture for a page.
    pub fn svg(&self) -> String {
        let (x, y) = (|p: f64| 60.0 + 400.0 * p, |p: f64| 430.0 - 400.0 * p);
        let mut text = String::from(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 490 490\" \
             font-family=\"sans-serif\" font-size=\"13\">\n\
             <rect width=\"490\" height=\"490\" fill=\"#fff\"/>\n",
        );
        for tick in 0..=5 {
            let p = f64::from(tick) / 5.0;
            let _ = writeln!(
                text,
                "<path d=\"M{0:.0} {1:.0}V{2:.0}M{3:.0} {4:.0}H{5:.0}\" stroke=\"#ddd\"/>\
                 <text x=\"{0:.0}\" y=\"450\" text-anchor=\"middle\">{p:.1}</text>\
                 <text x=\"52\" y=\"{6:.0}\" text-anchor=\"end\">{p:.1}</text>",
                x(p),
                y(0.0),
                y(1.0),
                x(0.0),
                y(p),
                x(1.0),
                y(p) + 4.0
            );
        }
        let _ = writeln!(
            text,
            "<path d=\"M{:.0} {:.0}L{:.0} {:.0}\" stroke=\"#888\" stroke-dasharray=\"5 4\"/>",
            x(0.0),
            y(0.0),
            x(1.0),
            y(1.0)
        );
        for bin in self.bins.iter().filter(|b| b.passes > 0) {
            let bar = |p: f64| y(p.clamp(0.0, 1.0));
            let _ = writeln!(
                text,
                "<path d=\"M{0:.1} {1:.1}V{2:.1}\" stroke=\"#0072b2\" stroke-width=\"2\"/>\
                 <circle cx=\"{0:.1}\" cy=\"{3:.1}\" r=\"{4:.1}\" fill=\"#0072b2\"/>",
                x(bin.predicted),
                bar(bin.observed - 1.96 * bin.uncertainty),
                bar(bin.observed + 1.96 * bin.uncertainty),
                bar(bin.observed),
                2.0 + (bin.passes as f64).sqrt() / 2.0
            );
        }
        text.push_str(
            "<text x=\"260\" y=\"476\" text-anchor=\"middle\">predicted probability of detection</text>\n\
             <text transform=\"translate(18 230) rotate(-90)\" text-anchor=\"middle\">observed share of \
             frames, 95 % bars</text>\n</svg>\n",
        );
        text
    }
}

fn summed(passes: &[&Pass]) -> ReliabilityBin {
    let frames: usize = passes.iter().map(|p| p.frames).sum();
    if frames == 0 {
        return ReliabilityBin::default();
    }
    let n = frames as f64;
    let found: usize = passes.iter().map(|p| p.found).sum();
    let observed = found as f64 / n;
    let said: f64 = passes.iter().map(|p| p.predicted * p.frames as f64).sum();
    // Ratio estimate over clusters (Cochran 1977, 6.13).
    let residual = |p: &&Pass| (p.found as f64 - observed * p.frames as f64).powi(2);
    let k = passes.len() as f64;
    let variance = passes.iter().map(residual).sum::<f64>() * k / (k - 1.0).max(1.0);
    ReliabilityBin {
        passes: passes.len(),
        frames,
        predicted: said / n,
        observed,
        uncertainty: variance.sqrt() / n,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};

    fn passes(truth: impl Fn(f64) -> f64) -> Vec<Pass> {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(9);
        (0..4000)
            .map(|_| {
                let predicted: f64 = random.random();
                let hit = |_: &usize| random.random::<f64>() < truth(predicted);
                Pass {
                    predicted,
                    frames: 8,
                    found: (0..8).filter(hit).count(),
                    wrong: 0,
                }
            })
            .collect()
    }

    #[test]
    fn what_comes_true_as_often_as_it_was_said_lies_on_the_diagonal() {
        let reliability = Reliability::of(&passes(|p| p));
        assert!(reliability.largest_difference(20) < 0.03, "{reliability:?}");
        let bin = reliability.bins[4];
        let expected = (0.45 * 0.55 / bin.frames as f64).sqrt();
        assert!((bin.uncertainty / expected - 1.0).abs() < 0.3, "{bin:?}");
        let svg = reliability.svg();
        assert_eq!(svg.matches("<circle").count(), 10);
        assert!(svg.ends_with("</svg>\n"));
    }

    #[test]
    fn boasting_is_seen() {
        let reliability = Reliability::of(&passes(|p| 0.8 * p));
        let top = reliability.bins[9];
        assert!(
            (top.predicted - top.observed - 0.19).abs() < 0.03,
            "{top:?}"
        );
    }
}
