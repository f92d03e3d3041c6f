//! Two fields of a log as pairs of values of one time.

use std::ops::Range;

use super::PlottedSeries;

/// Two fields side by side: the samples of `y`, and `x` between its samples at their times.
#[derive(Clone, Copy)]
pub(super) struct Pairs<'a> {
    pub x: &'a PlottedSeries,
    pub y: &'a PlottedSeries,
}

/// Index in `x` at which the last pair was found: the next is mostly near.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LastPair(usize);

impl Pairs<'_> {
    /// Numbers of the samples from `span.0` to `span.1` seconds.
    pub fn within(&self, span: (f64, f64)) -> Range<usize> {
        let times = &self.y.times;
        let from = times.partition_point(|time| *time < span.0);
        let to = times.partition_point(|time| *time <= span.1);
        from..to.max(from)
    }

    /// The pair of sample `index`, `None` where either is missing.
    pub fn at(&self, index: usize, place: &mut LastPair) -> Option<(f64, f64)> {
        let y = self.y.base + f64::from(self.y.values().get(index)?);
        Some((self.x_at(self.y.times[index], index, place)?, y))
    }

    /// The pair of the last sample at or before `time`.
    pub fn before(&self, time: f64) -> Option<(f64, f64)> {
        let after = self.y.times.partition_point(|t| *t <= time);
        self.at(after.checked_sub(1)?, &mut LastPair::default())
    }

    /// `x` at a time; fields of one topic have their samples at the same places.
    fn x_at(&self, time: f64, index: usize, place: &mut LastPair) -> Option<f64> {
        let times = &self.x.times;
        let value = |i: usize| Some(self.x.base + f64::from(self.x.values().get(i)?));
        if times.get(index) == Some(&time) {
            return value(index);
        }
        place.0 = last_not_after(times, time, place.0)?;
        let before = place.0;
        if times[before] == time {
            return value(before);
        }
        let next = times.get(before + 1)?;
        let weight = (time - times[before]) / (next - times[before]);
        let (low, high) = (value(before)?, value(before + 1)?);
        Some(low + weight * (high - low))
    }
}

/// Index of the last time that is not after `time`, sought around the `guess`-th.
fn last_not_after(times: &[f64], time: f64, guess: usize) -> Option<usize> {
    let guess = guess.min(times.len().checked_sub(1)?);
    let (mut low, mut high) = (guess, guess + 1);
    let mut step = 1;
    while low > 0 && times[low] > time {
        high = low;
        low = low.saturating_sub(step);
        step *= 2;
    }
    step = 1;
    while high < times.len() && times[high] <= time {
        low = high;
        high = (high + step).min(times.len());
        step *= 2;
    }
    let count = times[low..high].partition_point(|t| *t <= time);
    (low + count).checked_sub(1)
}

#[cfg(test)]
pub(super) mod tests {
    use pilotage_core::flight::expression::TimedSamples;

    use super::*;
    use pilotage_jobs::{LogSeries, SeriesName};

    /// A field as it comes from a worker.
    pub fn field(samples: impl Iterator<Item = (f64, f64)>) -> PlottedSeries {
        let all = TimedSamples::in_order(samples, "m");
        let mut field = PlottedSeries::default();
        let name = SeriesName::expression("x");
        let base = LogSeries::base_of(&all);
        field.take(&LogSeries::piece(&name, &all, base, 0, all.times.len()));
        field
    }

    #[test]
    fn the_last_time_not_after_another_is_found_from_any_guess() {
        let times = [1.0, 2.0, 2.0, 3.5, 7.0, 8.0, 9.0];
        for guess in [0, 2, 5, 6, 40] {
            for time in [0.0, 1.0, 1.5, 2.0, 3.4, 3.5, 8.5, 9.0, 20.0] {
                let expected = times.partition_point(|t| *t <= time).checked_sub(1);
                let found = last_not_after(&times, time, guess);
                assert_eq!(found, expected, "{time} from {guess}");
            }
        }
        assert_eq!(last_not_after(&[], 1.0, 0), None);
    }

    #[test]
    fn pairs_are_of_the_times_of_one_field_and_the_other_lies_between_its_samples() {
        let seconds = (0..10).map(f64::from);
        let y = field(seconds.map(|t| (t + 0.5, 10.0 * t)));
        let seconds = (0..10).map(f64::from);
        let x = field(seconds.map(|t| (t, if t == 4.0 { f64::NAN } else { 2.0 * t })));
        let pairs = Pairs { x: &x, y: &y };
        let mut place = LastPair::default();
        assert_eq!(pairs.at(2, &mut place), Some((5.0, 20.0)));
        assert_eq!(pairs.at(3, &mut place), None);
        assert_eq!(pairs.at(9, &mut place), None);
        assert_eq!(pairs.within((2.0, 4.5)), 2..5);
        assert_eq!(pairs.before(2.7), Some((5.0, 20.0)));
        assert_eq!(pairs.before(0.2), None);
    }
}
