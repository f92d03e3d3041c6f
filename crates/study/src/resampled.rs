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

/// Fewest draws of which an interval is told: of fewer, resamples often hold one number only.
const FEWEST: f64 = 8.0;

/// Sums over what was drawn, counted from the first number.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    count: f64,
    values: f64,
    squares: f64,
}

impl Sums {
    fn add(&mut self, weight: f64, value: f64) {
        self.count += weight;
        self.values += weight * value;
        self.squares += weight * value * value;
    }

    fn mean(&self) -> f64 {
        self.values / self.count
    }

    /// Variance between the numbers, as of all there are.
    fn variance(&self) -> f64 {
        self.squares / self.count - self.mean().powi(2)
    }

    /// Standard deviation of the mean.
    fn error(&self) -> f64 {
        (self.variance() / (self.count - 1.0)).sqrt()
    }
}

/// Sums of one quantity in every resample.
#[derive(Clone, Debug)]
pub struct Resampled {
    first: Option<f64>,
    own: Sums,
    resamples: Vec<Sums>,
}

impl Resampled {
    /// Nothing yet.
    pub fn new() -> Self {
        Self {
            first: None,
            own: Sums::default(),
            resamples: vec![Sums::default(); RESAMPLES],
        }
    }

    /// Takes in a value of a draw with these weights.
    pub fn push(&mut self, value: f64, weights: &[f64]) {
        let value = value - *self.first.get_or_insert(value);
        self.own.add(1.0, value);
        for (sums, weight) in self.resamples.iter_mut().zip(weights) {
            sums.add(*weight, value);
        }
    }

    /// Interval of the mean with a confidence of 95 %, by Student's ratios of the resamples (the bootstrap-t, Efron and
    /// Tibshirani 1993, 12.5): it knows that few draws also tell their scatter badly, and to which side they are skewed.
    /// `None` of fewer than eight draws, and where resamples often have a single number only, as of rare events.
    pub fn interval(&self) -> Option<[f64; 2]> {
        let (own, first) = (self.own, self.first?);
        if own.count < FEWEST {
            return None;
        }
        let ratio = |of: &Sums| {
            let off = of.mean() - own.mean();
            // What is left of rounding is no scatter.
            let scatters = of.count > 1.0 && of.variance() > 1e-12 * own.variance();
            off / if scatters { of.error() } else { 0.0 }
        };
        let drawn = self.resamples.iter().filter(|of| of.count > 0.0);
        let mut ratios: Vec<f64> = drawn.map(ratio).filter(|it| !it.is_nan()).collect();
        ratios.sort_by(f64::total_cmp);
        let end = |share: f64| {
            let ratio = pilotage_core::filter::quantile(&ratios, share)?;
            let end = first + own.mean() - ratio * own.error();
            end.is_finite().then_some(end)
        };
        Some([end(1.0 - TAIL)?, end(TAIL)?])
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
    fn of_few_and_skewed_numbers_it_holds_the_truth_as_well_or_is_none() {
        // Numbers of the exponential law, of mean 1.
        let interval = |study: u64, draws: u64| {
            let random = Philox::new(study);
            let mut resampled = Resampled::new();
            for draw in 0..draws {
                let value = -random.unit(Stream::Setting, draw, 0).ln();
                resampled.push(1e3 + value, &weights(random, draw));
            }
            resampled.interval()
        };
        for draws in [8, 10, 20] {
            let held = (0..500).filter(|study| {
                let [low, high] = interval(*study, draws).unwrap();
                low <= 1001.0 && 1001.0 <= high
            });
            // By percentiles it was 86 to 90 %. The deviation of the share is 1 %.
            let held = held.count();
            assert!((455..=495).contains(&held), "{draws}: {held}");
        }
        assert_eq!(interval(1, 7), None);
        // Three flights that differ are too few to tell how often others do.
        let rare = |events: u64| {
            let random = Philox::new(1);
            let mut resampled = Resampled::new();
            for draw in 0..100 {
                let value = f64::from(u8::from(draw < events));
                resampled.push(value, &weights(random, draw));
            }
            resampled.interval()
        };
        assert!(rare(1).is_none() && rare(2).is_none() && rare(20).is_some());
    }

    #[test]
    fn nothing_has_no_interval() {
        assert_eq!(Resampled::new().interval(), None);
    }
}
