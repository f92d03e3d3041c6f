//! A measure in a cell, gathered in constant memory.

use pilotage_core::filter::quantile_ranks;
use pilotage_core::training::evaluation::wilson;
use serde::{Deserialize, Serialize};
use sketches_ddsketch::{Config, DDSketch};

use super::resampled::Resampled;

/// Relative error of quantiles.
const QUANTILE_ERROR: f64 = 0.005;
/// Most bins of a sketch, enough for fifteen powers of ten.
const BINS: u32 = 4096;
/// Smallest number that is not counted as zero.
const SMALLEST: f64 = 1e-9;
/// Standard normal value of 97.5 %.
const NORMAL: f64 = 1.959_964;
/// Shares whose quantiles are told.
const SHARES: [f64; 7] = [0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99];

/// Way in which an interval was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum IntervalBy {
    /// Wilson's of a share.
    Wilson,
    /// The bootstrap over draws.
    Bootstrap,
    /// Student's, of the means of independent scrambles.
    Scrambles,
}

/// Quantile with its interval.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct QuantileSummary {
    /// Share of the flights below it.
    pub share: f64,
    /// Value, with a relative error of half a percent.
    pub value: f64,
    /// Its interval with a confidence of 95 %, by the binomial law of ranks; none where draws are not independent, or too
    /// few to bound it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interval: Option<[f64; 2]>,
}

/// Mean with its interval.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeanSummary {
    /// Number of flights that have such a number.
    pub count: u64,
    /// Number of flights that have none.
    pub missing: u64,
    /// Mean.
    pub mean: f64,
    /// Standard deviation between flights.
    pub deviation: f64,
    /// Interval of the mean with a confidence of 95 %; none of numbers that are all alike or of fewer than eight draws, which
    /// do not tell it, unless it is that of a share.
    pub interval: Option<[f64; 2]>,
    /// Way in which that was found.
    pub interval_by: IntervalBy,
}

/// Independent samples behind an interval.
enum Samples {
    /// Every draw.
    Draws(Resampled),
    /// Every scramble: number and sum.
    Scrambles(Vec<(f64, f64)>),
}

/// Numbers of one measure in one cell.
pub struct MeasureTally {
    is_share: bool,
    /// Smallest and largest number that there can be, so that no mean lies beyond.
    range: [f64; 2],
    count: u64,
    missing: u64,
    mean: f64,
    /// Sum of squares about the mean (Welford 1962).
    squares: f64,
    sketch: Option<DDSketch>,
    samples: Samples,
}

/// Place of a draw among the independent samples.
pub enum DrawPlace<'a> {
    /// A sample of its own, with its weights in the resamples.
    Own(&'a [f64]),
    /// In the scramble of that number.
    Scramble(usize),
}

impl MeasureTally {
    /// Nothing yet, of numbers within a range or of a share; `scrambles` share the draws if they are no samples of their
    /// own, and quantiles are kept if asked for.
    pub fn new(
        is_share: bool,
        range: [f64; 2],
        scrambles: Option<u64>,
        has_quantiles: bool,
    ) -> Self {
        let config = || Config::new(QUANTILE_ERROR, BINS, SMALLEST);
        Self {
            is_share,
            range,
            count: 0,
            missing: 0,
            mean: 0.0,
            squares: 0.0,
            sketch: has_quantiles.then(|| DDSketch::new(config())),
            samples: match scrambles {
                None => Samples::Draws(Resampled::new()),
                Some(count) => Samples::Scrambles(vec![(0.0, 0.0); count as usize]),
            },
        }
    }

    /// Takes in the number of a draw, or that it has none.
    pub fn push(&mut self, value: Option<f64>, place: &DrawPlace<'_>) {
        let Some(value) = value.filter(|value| value.is_finite()) else {
            self.missing += 1;
            return;
        };
        self.count += 1;
        let off = value - self.mean;
        self.mean += off / self.count as f64;
        self.squares += off * (value - self.mean);
        if let Some(sketch) = &mut self.sketch {
            sketch.add(value);
        }
        match (&mut self.samples, place) {
            (Samples::Draws(resampled), DrawPlace::Own(weights)) => resampled.push(value, weights),
            (Samples::Scrambles(scrambles), DrawPlace::Scramble(number)) => {
                scrambles[*number].0 += 1.0;
                scrambles[*number].1 += value;
            }
            _ => {}
        }
    }

    fn interval(&self) -> (Option<[f64; 2]>, IntervalBy) {
        let [least, greatest] = self.range;
        let (interval, by) = self.unbounded();
        let within = |ends: [f64; 2]| ends.map(|end| end.clamp(least, greatest));
        (interval.map(within), by)
    }

    /// The interval, which may reach beyond the range of the numbers.
    fn unbounded(&self) -> (Option<[f64; 2]>, IntervalBy) {
        match &self.samples {
            Samples::Draws(_) if self.is_share => (self.wilsons(), IntervalBy::Wilson),
            Samples::Draws(resampled) => {
                let interval = resampled.interval().filter(|_| self.scatters());
                (interval, IntervalBy::Bootstrap)
            }
            Samples::Scrambles(scrambles) => self.of_scrambles(scrambles),
        }
    }

    fn of_scrambles(&self, scrambles: &[(f64, f64)]) -> (Option<[f64; 2]>, IntervalBy) {
        if scrambles.iter().any(|(count, _)| *count == 0.0) {
            return (None, IntervalBy::Scrambles);
        }
        let means: Vec<f64> = scrambles.iter().map(|(count, sum)| sum / count).collect();
        let are_alike = means.iter().all(|mean| *mean == means[0]);
        match (are_alike, self.is_share) {
            // Draws by points scatter no more than independent ones.
            (true, true) => (self.wilsons(), IntervalBy::Wilson),
            (true, false) => (None, IntervalBy::Scrambles),
            (false, _) => (Some(students(&means)), IntervalBy::Scrambles),
        }
    }

    /// Whether its numbers differ: from those that are all alike nothing is known of how far others may lie from them.
    fn scatters(&self) -> bool {
        self.squares > 0.0
    }

    /// Wilson's interval of a share of flights.
    fn wilsons(&self) -> Option<[f64; 2]> {
        let count = self.count as f64;
        let (low, high) = wilson((self.mean * count).round(), count);
        (self.count > 0).then_some([low, high])
    }

    /// Half the width of the interval; infinite without one, as of numbers that are all alike.
    pub fn half_width(&self) -> f64 {
        let interval = self.interval().0.filter(|_| self.count > 0);
        interval.map_or(f64::INFINITY, |[low, high]| 0.5 * (high - low))
    }

    /// The mean and its interval; `None` without any number.
    pub fn mean(&self) -> Option<MeanSummary> {
        let (interval, interval_by) = self.interval();
        (self.count > 0).then(|| MeanSummary {
            count: self.count,
            missing: self.missing,
            mean: self.mean,
            deviation: (self.squares / (self.count.max(2) - 1) as f64)
                .max(0.0)
                .sqrt(),
            interval,
            interval_by,
        })
    }

    /// Quantiles with their intervals; none of a share.
    pub fn quantiles(&self) -> Vec<QuantileSummary> {
        let Some(sketch) = self.sketch.as_ref().filter(|_| self.count > 0) else {
            return Vec::new();
        };
        let ends = self.ends();
        let at = |share: f64| {
            let value = sketch.quantile(share.clamp(0.0, 1.0)).ok().flatten()?;
            // The middle of a bin may lie beyond the last number in it.
            ends.map(|[least, greatest]| value.clamp(least, greatest))
        };
        let last = self.count - 1;
        let ranked = |rank: u64| match ends? {
            [least, _] if rank == 0 => Some(least),
            [_, greatest] if rank == last => Some(greatest),
            // The sketch takes the rank below the share.
            _ => at((rank as f64 + 0.5) / last as f64),
        };
        let are_independent = matches!(self.samples, Samples::Draws(_));
        let of = |share: f64| {
            let ranks = quantile_ranks(self.count, share).filter(|_| are_independent);
            Some(QuantileSummary {
                share,
                value: at(share)?,
                interval: ranks.and_then(|[low, high]| Some([ranked(low)?, ranked(high)?])),
            })
        };
        SHARES.into_iter().filter_map(of).collect()
    }

    /// The smallest and the largest number.
    pub fn ends(&self) -> Option<[f64; 2]> {
        let sketch = self.sketch.as_ref()?;
        Some([sketch.min()?, sketch.max()?])
    }
}

/// Student's interval of the mean of the means of scrambles.
fn students(means: &[f64]) -> [f64; 2] {
    let count = means.len() as f64;
    let mean = means.iter().sum::<f64>() / count;
    let squares = means
        .iter()
        .map(|of_one| (of_one - mean).powi(2))
        .sum::<f64>();
    let error = (squares / (count - 1.0) / count).sqrt();
    let margin = student(count - 1.0) * error;
    [mean - margin, mean + margin]
}

/// Value below which a variable of Student's with `freedom` degrees lies with 97.5 %; Fisher and Cornish's expansion
/// (Abramowitz and Stegun 26.7.5), right to a thousandth from seven degrees on.
fn student(freedom: f64) -> f64 {
    let z = NORMAL;
    let first = (z.powi(3) + z) / 4.0;
    let second = (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / 96.0;
    let third = (3.0 * z.powi(7) + 19.0 * z.powi(5) + 17.0 * z.powi(3) - 15.0 * z) / 384.0;
    z + first / freedom + second / freedom.powi(2) + third / freedom.powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::philox::{Philox, Stream};
    use crate::resampled::weights;

    const ANY: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

    #[test]
    fn students_values_are_those_of_printed_tables() {
        for (freedom, value) in [
            (7.0, 2.3646),
            (15.0, 2.1314),
            (30.0, 2.0423),
            (100.0, 1.9840),
        ] {
            assert!((student(freedom) - value).abs() < 1e-3, "{freedom}");
        }
    }

    #[test]
    fn quantiles_err_by_half_a_percent_and_shares_have_wilsons_interval() {
        let random = Philox::new(11);
        let mut tally = MeasureTally::new(false, ANY, None, true);
        let mut share = MeasureTally::new(true, [0.0, 1.0], None, false);
        let mut values: Vec<f64> = Vec::new();
        for draw in 0..5000 {
            // Of many sizes, from 0.02 to 50.
            let value = 50.0 * random.unit(Stream::Setting, draw, 0).powi(4) + 0.02;
            values.push(value);
            let weights = weights(random, draw);
            tally.push(Some(value), &DrawPlace::Own(&weights));
            let is_small = f64::from(u8::from(value < 1.0));
            share.push(Some(is_small), &DrawPlace::Own(&weights));
        }
        values.sort_by(f64::total_cmp);
        for told in tally.quantiles() {
            let exact = values[(told.share * 4999.0) as usize];
            assert!(
                (told.value / exact - 1.0).abs() < 0.0051,
                "{told:?} {exact}"
            );
            let [low, high] = told.interval.unwrap();
            assert!(low <= told.value && told.value <= high);
        }
        let all_alike = |value: f64| {
            let mut tally = MeasureTally::new(false, ANY, None, true);
            tally.push(Some(value), &DrawPlace::Own(&[1.0]));
            tally.quantiles()
        };
        // Never beyond the numbers themselves.
        assert!(all_alike(0.973).iter().all(|told| told.value == 0.973));
        let small = values.iter().filter(|value| **value < 1.0).count() as f64;
        let summary = share.mean().unwrap();
        let (low, high) = wilson(small, 5000.0);
        assert_eq!(summary.interval, Some([low, high]));
        let exact = values.iter().sum::<f64>() / 5000.0;
        let summary = tally.mean().unwrap();
        assert!((summary.mean - exact).abs() < 1e-9);
        let [low, high] = summary.interval.unwrap();
        let normal = NORMAL * summary.deviation / 5000.0_f64.sqrt();
        assert!(((high - low) / (2.0 * normal) - 1.0).abs() < 0.12);
        assert_eq!(tally.ends(), Some([values[0], values[4999]]));
    }

    #[test]
    fn quantiles_of_few_flights_have_the_interval_of_their_ranks_or_none() {
        let interval = |count: u32, share: f64| {
            let mut tally = MeasureTally::new(false, ANY, None, true);
            for value in 1..=count {
                tally.push(Some(f64::from(value)), &DrawPlace::Own(&[1.0]));
            }
            let told = tally.quantiles().into_iter().find(|it| it.share == share);
            told.unwrap().interval
        };
        assert_eq!(interval(4, 0.5), None);
        assert_eq!(interval(8, 0.5), Some([1.0, 8.0]));
        // By SciPy's binomial law the 40th and the 61st of 100, the 64th and the 72nd of 72.
        for (count, share, ends) in [(100, 0.5, [40.0, 61.0]), (72, 0.95, [64.0, 72.0])] {
            for (told, end) in interval(count, share).unwrap().into_iter().zip(ends) {
                assert!((told / end - 1.0).abs() < 0.0051, "{count}: {told} {end}");
            }
        }
    }

    #[test]
    fn no_interval_reaches_beyond_what_can_be() {
        let random = Philox::new(5);
        // One flight is far from the others: without the bound, -0.20 to 1.01.
        let shares = [1.0, 0.99, 0.98, 0.999, 0.5, 0.97, 0.96, 1.0];
        let mut tally = MeasureTally::new(false, [0.0, 1.0], None, false);
        for (draw, share) in shares.into_iter().enumerate() {
            let weights = weights(random, draw as u64);
            tally.push(Some(share), &DrawPlace::Own(&weights));
        }
        assert_eq!(tally.mean().unwrap().interval, Some([0.0, 1.0]));
    }

    #[test]
    fn what_has_no_number_is_counted_and_left_out() {
        let mut tally = MeasureTally::new(false, ANY, Some(2), true);
        for (value, scramble) in [
            (Some(1.0), 0),
            (None, 0),
            (Some(f64::NAN), 1),
            (Some(3.0), 1),
        ] {
            tally.push(value, &DrawPlace::Scramble(scramble));
        }
        let summary = tally.mean().unwrap();
        assert_eq!((summary.count, summary.missing, summary.mean), (2, 2, 2.0));
        assert_eq!(summary.interval_by, IntervalBy::Scrambles);
    }
}
