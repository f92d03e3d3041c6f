//! Statistics of a series within a span of time.

use serde::{Deserialize, Serialize};

use super::expression::TimedSamples;

/// Statistics of a series within a span of time. Values have the unit of the series; what is no number (NaN
/// or infinite) is not counted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpanStatistics {
    /// Number of values.
    pub count: usize,
    /// Samples within the span that are no number.
    pub missing: usize,
    /// Least value.
    pub least: f64,
    /// Greatest value.
    pub greatest: f64,
    /// Mean value, every sample counting the same.
    pub mean: f64,
    /// Standard deviation of the values around their mean, with n − 1; of a single value `None`.
    pub deviation: Option<f64>,
    /// The value in the middle: as many lie below as above.
    pub median: f64,
    /// Time (seconds) and value of the first.
    pub first: (f64, f64),
    /// Time and value of the last.
    pub last: (f64, f64),
}

impl SpanStatistics {
    /// Of the samples from `span.0` to `span.1` seconds, both included; `None` if no number is among them.
    ///
    /// ```
    /// use pilotage_readers::{SpanStatistics, expression::TimedSamples};
    ///
    /// let values = [1.0, 2.0, 4.0, 5.0, 100.0];
    /// let samples = TimedSamples::new(values.into_iter().enumerate().map(|(t, v)| (t as f64, v)), "m");
    /// // From 0 to 3 s; deviations from the mean are 2, 1, 1 and 2: (4 + 1 + 1 + 4) / 3.
    /// let span = SpanStatistics::of(&samples, (0.0, 3.0)).ok_or("no number")?;
    /// assert_eq!((span.count, span.mean, span.median), (4, 3.0, 3.0));
    /// assert!((span.deviation.ok_or("one value")? - (10.0_f64 / 3.0).sqrt()).abs() < 1e-12);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn of(samples: &TimedSamples, span: (f64, f64)) -> Option<Self> {
        let within = samples.within(span);
        let times = &samples.times[within.clone()];
        let all = &samples.values[within];
        let numbers = times.iter().zip(all).filter(|(_, value)| value.is_finite());
        let pair = |(time, value): (&f64, &f64)| (*time, *value);
        let first = numbers.clone().next().map(pair)?;
        let last = numbers.clone().next_back().map(pair)?;
        let mut values: Vec<f64> = numbers.map(|(_, value)| *value).collect();
        let count = values.len();
        // Told against the first value, so that small changes around a large one keep their digits.
        let sum: f64 = values.iter().map(|value| value - first.1).sum();
        let mean = first.1 + sum / count as f64;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let deviation = (count > 1).then(|| (squares / (count - 1) as f64).sqrt());
        let (least, greatest) = values
            .iter()
            .fold((first.1, first.1), |(low, high), value| {
                (value.min(low), value.max(high))
            });
        Some(Self {
            count,
            missing: all.len() - count,
            least,
            greatest,
            mean,
            deviation,
            median: median(&mut values),
            first,
            last,
        })
    }

    /// Last value less the first.
    pub fn change(&self) -> f64 {
        self.last.1 - self.first.1
    }

    /// Change per second; `None` if first and last are of one time.
    pub fn rate(&self) -> Option<f64> {
        let seconds = self.last.0 - self.first.0;
        (seconds > 0.0).then(|| self.change() / seconds)
    }
}

/// The value in the middle of some, the mean of both if there are two; their order is lost.
fn median(values: &mut [f64]) -> f64 {
    let middle = values.len() / 2;
    let is_odd = values.len() % 2 == 1;
    let (below, upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    if is_odd {
        return *upper;
    }
    let lower = below.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    lower + 0.5 * (*upper - lower)
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    fn samples(values: &[f64]) -> TimedSamples {
        let times = (0..values.len()).map(|i| 0.5 * i as f64);
        TimedSamples::new(times.zip(values.iter().copied()), "m")
    }

    #[test]
    fn the_figures_are_those_of_a_textbook() {
        // Mean 5, sum of squares 32.
        let all = samples(&[9.0, 2.0, 4.0, 4.0, 5.0, 4.0, 5.0, 7.0]);
        let found = SpanStatistics::of(&all, (0.0, 10.0)).unwrap();
        assert_eq!((found.count, found.missing), (8, 0));
        assert_eq!((found.least, found.greatest, found.mean), (2.0, 9.0, 5.0));
        assert_abs_diff_eq!(found.deviation.unwrap(), (32.0_f64 / 7.0).sqrt());
        assert_eq!(found.median, 4.5);
        assert_eq!((found.change(), found.rate()), (-2.0, Some(-2.0 / 3.5)));
    }

    #[test]
    fn both_ends_of_the_span_count_and_what_is_no_number_does_not() {
        let all = samples(&[1.0, 2.0, f64::NAN, 4.0, 100.0, f64::INFINITY]);
        let found = SpanStatistics::of(&all, (0.5, 1.5)).unwrap();
        assert_eq!((found.count, found.missing), (2, 1));
        assert_eq!((found.first, found.last), ((0.5, 2.0), (1.5, 4.0)));
        assert_eq!(found.median, 3.0);
        assert_eq!(SpanStatistics::of(&all, (1.0, 1.2)), None);
        assert_eq!(SpanStatistics::of(&all, (2.5, 9.0)), None);
        let single = SpanStatistics::of(&all, (2.0, 2.4)).unwrap();
        assert_eq!((single.deviation, single.rate()), (None, None));
    }

    #[test]
    fn small_changes_of_a_large_value_are_not_lost() {
        let values: Vec<f64> = (0..10_001).map(|i| 1e12 + f64::from(i % 2)).collect();
        let found = SpanStatistics::of(&samples(&values), (0.0, 1e9)).unwrap();
        assert_abs_diff_eq!(found.mean - 1e12, 5000.0 / 10_001.0, epsilon = 1e-3);
        assert_abs_diff_eq!(found.deviation.unwrap(), 0.5, epsilon = 1e-3);
    }
}
