//! A cleaned series of one instrument.

use nalgebra::Vector2;

/// Longest pause over which a series is still interpolated or held, seconds.
pub const LONGEST_GAP: f64 = 1.0;

/// Samples of something that can be interpolated, in strictly increasing order of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series<T = f64> {
    times: Vec<f64>,
    values: Vec<T>,
}

/// Values that a series may hold: numbers, and vectors in the plane.
pub trait SeriesValue: Copy {
    /// The value at `fraction` of the way from `self` to `other`.
    #[must_use]
    fn towards(self, other: Self, fraction: f64) -> Self;
}

impl SeriesValue for f64 {
    fn towards(self, other: Self, fraction: f64) -> Self {
        self + fraction * (other - self)
    }
}

impl SeriesValue for Vector2<f64> {
    fn towards(self, other: Self, fraction: f64) -> Self {
        self + fraction * (other - self)
    }
}

impl<T: SeriesValue> Series<T> {
    /// An empty series.
    pub fn new() -> Self {
        Self {
            times: Vec::new(),
            values: Vec::new(),
        }
    }

    /// Adds a sample unless it is not later than the last one; whether it did.
    pub fn push(&mut self, time: f64, value: T) -> bool {
        let is_later = self.times.last().is_none_or(|last| time > *last) && time.is_finite();
        if is_later {
            self.times.push(time);
            self.values.push(value);
        }
        is_later
    }

    /// Times of the samples, seconds.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Values of the samples.
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// Whether there is no sample.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// Times with their values.
    pub fn iter(&self) -> impl Iterator<Item = (f64, T)> + '_ {
        self.times.iter().copied().zip(self.values.iter().copied())
    }

    /// Those samples after `from` and up to `to`, seconds.
    pub fn between(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, T)> + '_ {
        let first = self.times.partition_point(|t| *t <= from);
        let end = self.times.partition_point(|t| *t <= to).max(first);
        let times = self.times[first..end].iter().copied();
        times.zip(self.values[first..end].iter().copied())
    }

    /// The value at `time`: by linear interpolation over pauses of at most `LONGEST_GAP`, held as long as
    /// that at the edges of longer ones, `None` inside them.
    ///
    /// ```
    /// use pilotage_navigator::instruments::Series;
    ///
    /// let mut airspeed = Series::new();
    /// for (time, value) in [(0.0, 18.0), (0.5, 20.0), (10.0, 30.0)] {
    ///     airspeed.push(time, value);
    /// }
    /// assert_eq!(airspeed.at(0.25), Some(19.0));
    /// // Nobody knows what it read in a pause of nine seconds.
    /// assert_eq!(airspeed.at(5.0), None);
    /// ```
    pub fn at(&self, time: f64) -> Option<T> {
        let after = first_after(&self.times, time);
        let earlier = after
            .checked_sub(1)
            .map(|i| (self.times[i], self.values[i]));
        let later = self.times.get(after).map(|t| (*t, self.values[after]));
        match (earlier, later) {
            (Some((t0, v0)), Some((t1, v1))) if t1 - t0 <= LONGEST_GAP => {
                Some(v0.towards(v1, (time - t0) / (t1 - t0)))
            }
            (Some((t0, v0)), _) if time - t0 <= LONGEST_GAP => Some(v0),
            (_, Some((t1, v1))) if t1 - time <= LONGEST_GAP => Some(v1),
            _ => None,
        }
    }

    /// The same series without the samples inside the spans (seconds).
    #[must_use]
    pub fn without(&self, spans: &[(f64, f64)]) -> Self {
        let is_outside = |time: f64| !spans.iter().any(|(from, to)| (*from..=*to).contains(&time));
        let (times, values) = self.iter().filter(|(time, _)| is_outside(*time)).unzip();
        Self { times, values }
    }
}

/// The index of the first of `times` (strictly increasing) after `time`: sought around where it is if samples are
/// evenly spaced, as those of most instruments are. Halving all of a long series took two fifths of dead
/// reckoning.
fn first_after(times: &[f64], time: f64) -> usize {
    let (Some(first), Some(last)) = (times.first(), times.last()) else {
        return 0;
    };
    let part = (time - first) / (last - first);
    let guess = ((part * times.len() as f64) as usize).min(times.len());
    let (mut from, mut to, mut step) = (guess, guess, 1);
    if guess == 0 || times[guess - 1] <= time {
        while to < times.len() && times[to] <= time {
            from = to + 1;
            to += step;
            step *= 2;
        }
        to = to.min(times.len());
    } else {
        while from > 0 && times[from - 1] > time {
            to = from - 1;
            from = from.saturating_sub(step);
            step *= 2;
        }
    }
    from + times[from..to].partition_point(|t| *t <= time)
}

impl Series {
    /// The mean over `half` seconds to each side of every sample, less at the edges of pauses, as much to both sides.
    #[must_use]
    pub fn averaged(&self, half: f64) -> Self {
        let mut sums = vec![0.0];
        for value in &self.values {
            sums.push(sums[sums.len() - 1] + value);
        }
        let mut averaged = Self::new();
        let mut begin = 0;
        while begin < self.times.len() {
            let later = self.times[begin..].windows(2);
            let length = later.take_while(|t| t[1] - t[0] <= LONGEST_GAP).count() + 1;
            let run = &self.times[begin..begin + length];
            let (first, last) = (run[0], run[length - 1]);
            for time in run {
                let reach = half.min(time - first).min(last - time);
                let from = begin + run.partition_point(|t| *t < time - reach);
                let to = begin + run.partition_point(|t| *t <= time + reach);
                averaged.push(*time, (sums[to] - sums[from]) / (to - from) as f64);
            }
            begin += length;
        }
        averaged
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series() -> Series {
        let mut series = Series::new();
        for (time, value) in [(0.0, 1.0), (0.5, 2.0), (5.0, 4.0), (5.5, 6.0)] {
            assert!(series.push(time, value));
        }
        series
    }

    #[test]
    fn values_between_samples_lie_on_a_line_and_long_pauses_have_none() {
        let series = series();
        assert_eq!(series.at(0.25), Some(1.5));
        assert_eq!(series.at(5.25), Some(5.0));
        assert_eq!(series.at(1.4), Some(2.0));
        assert_eq!(series.at(2.5), None);
        assert_eq!(series.at(4.5), Some(4.0));
        assert_eq!(series.at(-2.0), None);
        assert_eq!(series.at(9.0), None);
    }

    #[test]
    fn the_sample_after_a_time_is_that_which_halving_finds_however_samples_are_spaced() {
        let spacings: [fn(f64) -> f64; 4] = [
            |i| 0.1 * i,
            |i| 0.1 * i + 0.04 * (1.7 * i).sin(),
            |i| 0.1 * i + if i > 60.0 { 5000.0 } else { 0.0 },
            |i| 1.05_f64.powf(i),
        ];
        for spacing in spacings {
            for count in [0, 1, 2, 3, 7, 150] {
                let times: Vec<f64> = (0..count).map(|i| spacing(f64::from(i))).collect();
                let between = times.windows(2).map(|t| 0.5 * (t[0] + t[1]));
                let beside = [f64::NEG_INFINITY, -1.0, 6000.0, f64::INFINITY, f64::NAN];
                for time in between.chain(times.iter().copied()).chain(beside) {
                    let expected = times.partition_point(|t| *t <= time);
                    assert_eq!(first_after(&times, time), expected, "{count}: {time}");
                }
            }
        }
    }

    #[test]
    fn means_reach_as_far_to_both_sides_and_not_over_pauses() {
        let mut ramp = Series::new();
        for i in 0..40 {
            let time = 0.5 * f64::from(i) + if i < 20 { 0.0 } else { 5.0 };
            ramp.push(time, 2.0 * time + if i % 2 == 0 { 1.0 } else { -1.0 });
        }
        let averaged = ramp.averaged(2.0);
        assert_eq!(averaged.times(), ramp.times());
        for (time, value) in averaged.iter() {
            assert!((value - 2.0 * time).abs() < 1.01, "{time}: {value}");
        }
        let inside = averaged.between(3.0, 7.0);
        assert!(inside.map(|(t, v)| v - 2.0 * t).all(|off| off.abs() < 0.12));
    }

    #[test]
    fn samples_that_do_not_come_later_are_turned_away() {
        let mut series = series();
        assert!(!series.push(5.5, 7.0));
        assert!(!series.push(1.0, 7.0));
        assert!(!series.push(f64::NAN, 7.0));
        assert_eq!(series.times().len(), 4);
    }

    #[test]
    fn a_stretch_is_open_at_its_beginning_and_closed_at_its_end() {
        let series = series();
        let times: Vec<f64> = series.between(0.0, 5.0).map(|(time, _)| time).collect();
        assert_eq!(times, [0.5, 5.0]);
        assert_eq!(series.between(3.0, 2.0).count(), 0);
        assert_eq!(series.without(&[(0.4, 5.1)]).times(), [0.0, 5.5]);
    }
}
