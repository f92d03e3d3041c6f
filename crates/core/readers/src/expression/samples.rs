//! Values with their times, and where expressions find them by name.

use std::f64::consts::TAU;

/// Values with their times.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TimedSamples {
    /// Seconds in the log's time base, not going back; growing, where expressions are to be made of them.
    pub times: Vec<f64>,
    /// Values, one per time; NaN where a value is missing.
    pub values: Vec<f64>,
    /// Unit of the values, or empty.
    pub unit: String,
}

impl TimedSamples {
    /// Samples in order of time: those without a time are left out, several at one time stay in their order.
    pub fn in_order(samples: impl Iterator<Item = (f64, f64)>, unit: impl Into<String>) -> Self {
        let (mut times, mut values) = (Vec::new(), Vec::new());
        times.reserve(samples.size_hint().0);
        values.reserve(samples.size_hint().0);
        let mut is_in_order = true;
        let mut last = f64::NEG_INFINITY;
        for (time, value) in samples {
            if time.is_finite() {
                is_in_order &= time >= last;
                last = time;
                times.push(time);
                values.push(value);
            }
        }
        if !is_in_order {
            let mut pairs: Vec<(f64, f64)> = times.into_iter().zip(values).collect();
            pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
            (times, values) = pairs.into_iter().unzip();
        }
        Self {
            times,
            values,
            unit: unit.into(),
        }
    }

    /// Samples in order of time: of several at one time, the last counts.
    ///
    /// ```
    /// use pilotage_readers::expression::TimedSamples;
    ///
    /// // Out of order, and two at one time.
    /// let samples = TimedSamples::new([(2.0, 20.0), (1.0, 10.0), (2.0, 21.0)].into_iter(), "m");
    /// assert_eq!((samples.times, samples.values), (vec![1.0, 2.0], vec![10.0, 21.0]));
    /// ```
    pub fn new(samples: impl Iterator<Item = (f64, f64)>, unit: impl Into<String>) -> Self {
        let mut all = Self::in_order(samples, unit);
        if all.times.windows(2).any(|pair| pair[0] == pair[1]) {
            let last: Vec<usize> = (0..all.times.len())
                .filter(|i| all.times.get(i + 1) != Some(&all.times[*i]))
                .collect();
            all.times = last.iter().map(|i| all.times[*i]).collect();
            all.values = last.iter().map(|i| all.values[*i]).collect();
        }
        all
    }

    /// Places of the samples from `span.0` to `span.1` seconds, both included.
    pub fn within(&self, span: (f64, f64)) -> std::ops::Range<usize> {
        let from = self.times.partition_point(|time| *time < span.0);
        let to = self.times.partition_point(|time| *time <= span.1);
        from..to.max(from)
    }

    /// Values that are a full turn apart, if the unit is one of angles.
    pub(super) fn period(&self) -> Option<f64> {
        match self.unit.as_str() {
            "deg" => Some(360.0),
            "rad" => Some(TAU),
            _ => None,
        }
    }
}

/// Source of the series of an expression.
pub trait SeriesSource {
    /// The series of that name.
    fn samples(&self, name: &str) -> Option<TimedSamples>;

    /// Every name.
    fn names(&self) -> Vec<String>;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_come_into_the_order_of_time_and_the_last_of_one_time_counts() {
        let given = [
            (2.0, 20.0),
            (1.0, 10.0),
            (f64::NAN, 5.0),
            (2.0, 21.0),
            (3.0, 30.0),
        ];
        let samples = TimedSamples::new(given.into_iter(), "m");
        assert_eq!(samples.times, [1.0, 2.0, 3.0]);
        assert_eq!(samples.values, [10.0, 21.0, 30.0]);
    }
}
