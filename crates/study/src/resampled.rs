//! Resampled means in constant memory: the Poisson bootstrap (Hanley and `MacGibbon` 2006; Chamandy et al. 2012).
//!
//! In each resample a draw counts a Poisson number of times, which is what drawing with replacement comes to for many
//! draws. The number depends on the draw and the resample alone, so that rows are seen once and none is kept; all cells
//! and measures of a draw share it, so that differences between cells keep what they have in common.

use super::philox::{Philox, Stream};

/// Number of resamples.
pub const RESAMPLES: usize = 400;
/// Ends of the interval, as shares of the resampled means.
const TAIL: f64 = 0.025;

/// Poisson weights of one draw in all resamples.
pub fn weights(random: Philox, draw: u64) -> Vec<f64> {
    let blocks = RESAMPLES.div_ceil(4) as u32;
    let words = (0..blocks).flat_map(|block| random.of(Stream::Weight, draw, block));
    words.take(RESAMPLES).map(poisson).collect()
}

/// Poisson number of mean 1 at the share `word` / 2³² of its distribution.
fn poisson(word: u32) -> f64 {
    let unit = (f64::from(word) + 0.5) / 2.0_f64.powi(32);
    let mut term = (-1.0_f64).exp();
    let (mut below, mut count) = (term, 0.0);
    // Beyond 20 lies less than what a word can tell.
    while unit > below && count < 20.0 {
        count += 1.0;
        term /= count;
        below += term;
    }
    count
}

/// Sums of one quantity in every resample.
#[derive(Clone, Debug)]
pub struct Resampled {
    counts: Vec<f64>,
    sums: Vec<f64>,
}

impl Resampled {
    /// Nothing yet.
    pub fn new() -> Self {
        Self {
            counts: vec![0.0; RESAMPLES],
            sums: vec![0.0; RESAMPLES],
        }
    }

    /// Takes in a value of a draw with these weights.
    pub fn push(&mut self, value: f64, weights: &[f64]) {
        let sums = self.counts.iter_mut().zip(&mut self.sums);
        for ((count, sum), weight) in sums.zip(weights) {
            *count += weight;
            *sum += weight * value;
        }
    }

    /// Interval of the mean with a confidence of 95 %, by percentiles; `None` where a resample is empty.
    pub fn interval(&self) -> Option<[f64; 2]> {
        if self.counts.contains(&0.0) {
            return None;
        }
        let sums = self.sums.iter().zip(&self.counts);
        let mut means: Vec<f64> = sums.map(|(sum, count)| sum / count).collect();
        means.sort_by(f64::total_cmp);
        let at = |share: f64| pilotage_core::filter::quantile(&means, share);
        Some([at(TAIL)?, at(1.0 - TAIL)?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_have_the_shares_of_a_poisson_number() {
        let random = Philox::new(3);
        let all: Vec<f64> = (0..100).flat_map(|draw| weights(random, draw)).collect();
        let share = |count: f64| {
            let such = all.iter().filter(|weight| **weight == count).count();
            such as f64 / all.len() as f64
        };
        // e⁻¹ / k!
        for (count, expected) in [(0.0, 0.3679), (1.0, 0.3679), (2.0, 0.1839), (4.0, 0.0153)] {
            assert!(
                (share(count) - expected).abs() < 0.008,
                "{count}: {}",
                share(count)
            );
        }
    }

    #[test]
    fn the_interval_is_that_of_the_normal_law_and_holds_the_truth_as_often_as_it_says() {
        let mut held = 0;
        let (studies, draws) = (200, 300);
        let mut width = 0.0;
        for study in 0..studies {
            let random = Philox::new(study);
            let mut resampled = Resampled::new();
            for draw in 0..draws {
                let value = random.unit(Stream::Setting, draw, 0);
                resampled.push(value, &weights(random, draw));
            }
            let [low, high] = resampled.interval().unwrap();
            held += u32::from(low <= 0.5 && 0.5 <= high);
            width += (high - low) / studies as f64;
        }
        // Means of 300 uniform numbers: 2 × 1.96 / √(12 × 300) = 0.0653.
        assert!((width / 0.0653 - 1.0).abs() < 0.05, "{width}");
        // 95 % of 200, within three deviations and what the bootstrap lacks.
        assert!((178..=199).contains(&held), "{held}");
    }

    #[test]
    fn nothing_has_no_interval() {
        assert_eq!(Resampled::new().interval(), None);
    }
}
