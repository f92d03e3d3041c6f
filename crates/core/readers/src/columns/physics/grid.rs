//! Series of different rates brought into cells of equal duration.

/// Gap between samples over which nothing is interpolated, seconds.
const GAP: f64 = 12.0;
/// Most cells.
const MOST: f64 = 20_000.0;

/// Numbers and when they were measured, seconds.
#[derive(Clone, Debug, Default)]
pub(super) struct TimedNumbers {
    pub times: Vec<f64>,
    pub values: Vec<f64>,
}

impl TimedNumbers {
    /// Those of both that are numbers, without those that are not later than the one before.
    pub fn new(times: &[f64], values: impl IntoIterator<Item = f64>) -> Self {
        let mut series = Self::default();
        for (time, value) in times.iter().zip(values) {
            let is_later = series.times.last().is_none_or(|last| time > last);
            if time.is_finite() && value.is_finite() && is_later {
                series.times.push(*time);
                series.values.push(value);
            }
        }
        series
    }

    /// The same with each value changed.
    pub fn map(&self, change: impl Fn(f64) -> f64) -> Self {
        Self {
            times: self.times.clone(),
            values: self.values.iter().map(|value| change(*value)).collect(),
        }
    }

    /// Angles in radians without jumps of a turn.
    pub fn unwrapped(&self) -> Self {
        let mut last = None;
        let mut values = Vec::with_capacity(self.values.len());
        for value in &self.values {
            let next = last.map_or(*value, |last: f64| {
                last + pilotage_base::frames::wrap_pi(value - last)
            });
            values.push(next);
            last = Some(next);
        }
        Self {
            times: self.times.clone(),
            values,
        }
    }

    /// The value at a time, between samples by straight lines; NaN outside and in gaps.
    pub fn at(&self, time: f64) -> f64 {
        let after = self.times.partition_point(|t| *t < time);
        let (Some(t1), Some(v1)) = (self.times.get(after), self.values.get(after)) else {
            return f64::NAN;
        };
        if *t1 == time {
            return *v1;
        }
        let Some(before) = after.checked_sub(1) else {
            return f64::NAN;
        };
        let (t0, v0) = (self.times[before], self.values[before]);
        if t1 - t0 > GAP {
            return f64::NAN;
        }
        v0 + (v1 - v0) * (time - t0) / (t1 - t0)
    }
}

/// Cells of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TimeCells {
    pub start: f64,
    pub step: f64,
    pub count: usize,
}

impl TimeCells {
    /// Cells of about a second from `start` to `end`, shorter ones of less than half a minute, none shorter than
    /// `least`; `None` if there are fewer than eight.
    pub fn new(start: f64, end: f64, least: f64) -> Option<Self> {
        let usual = ((end - start) / 30.0).min(1.0);
        let step = usual.max(least).max((end - start) / MOST);
        let count = ((end - start) / step).floor();
        (count >= 8.0 && count.is_finite()).then_some(Self {
            start,
            step,
            count: count as usize,
        })
    }

    fn edge(&self, index: usize) -> f64 {
        self.start + self.step * index as f64
    }

    /// The mean of the samples in each cell; where there is none, the value in its middle.
    pub fn mean(&self, series: &TimedNumbers) -> Vec<f64> {
        let mut sums = vec![(0.0, 0_usize); self.count];
        for (time, value) in series.times.iter().zip(&series.values) {
            let cell = ((time - self.start) / self.step).floor();
            if cell >= 0.0
                && let Some(sum) = sums.get_mut(cell as usize)
            {
                sum.0 += value;
                sum.1 += 1;
            }
        }
        let cell = |(index, (sum, count)): (usize, (f64, usize))| {
            if count > 0 {
                sum / count as f64
            } else {
                self.in_middle(series, index)
            }
        };
        sums.into_iter().enumerate().map(cell).collect()
    }

    /// The values of the samples in cells of which `reference` says something.
    pub fn where_known(&self, series: &TimedNumbers, reference: &[f64]) -> Vec<f64> {
        let is_known = |time: f64| {
            let cell = ((time - self.start) / self.step).floor();
            cell >= 0.0 && reference.get(cell as usize).is_some_and(|v| v.is_finite())
        };
        let samples = series.times.iter().zip(&series.values);
        let known = samples.filter(|(time, _)| is_known(**time));
        known.map(|(_, value)| *value).collect()
    }

    fn in_middle(&self, series: &TimedNumbers, index: usize) -> f64 {
        series.at(self.edge(index) + 0.5 * self.step)
    }

    /// The value in the middle of each cell.
    pub fn middle(&self, series: &TimedNumbers) -> Vec<f64> {
        let cells = 0..self.count;
        cells.map(|index| self.in_middle(series, index)).collect()
    }

    /// Change over each cell, per second.
    pub fn rate(&self, series: &TimedNumbers) -> Vec<f64> {
        let edges: Vec<f64> = (0..=self.count).map(|i| series.at(self.edge(i))).collect();
        edges
            .windows(2)
            .map(|w| (w[1] - w[0]) / self.step)
            .collect()
    }
}

/// The mean of `count` numbers around each, NaN at the ends.
pub(super) fn averaged(values: &[f64], count: usize) -> Vec<f64> {
    let half = count / 2;
    let mean = |index: usize| {
        let window = index
            .checked_sub(half)
            .and_then(|from| values.get(from..from + count));
        window.map_or(f64::NAN, |w| w.iter().sum::<f64>() / count as f64)
    };
    (0..values.len()).map(mean).collect()
}

/// The value below which that share of the numbers lies; NaN without any.
pub(super) fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let place = (share * sorted.len() as f64) as usize;
    let place = place.min(sorted.len().saturating_sub(1));
    sorted.get(place).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_have_the_mean_of_their_samples_and_the_change_over_them() {
        let times: Vec<f64> = (0..=400).map(|i| f64::from(i) * 0.1).collect();
        let series = TimedNumbers::new(&times, times.iter().map(|t| 3.0 * t));
        let grid = TimeCells::new(0.0, 40.0, 0.0).unwrap();
        assert_eq!(grid.count, 40);
        let (mean, rate) = (grid.mean(&series), grid.rate(&series));
        assert!((mean[4] - 3.0 * 4.45).abs() < 1e-9);
        assert!(rate.iter().all(|rate| (rate - 3.0).abs() < 1e-9));
        let angles = TimedNumbers::new(
            &times,
            times.iter().map(|t| pilotage_base::frames::wrap_pi(*t)),
        );
        assert!((angles.unwrapped().values[200] - 20.0).abs() < 1e-9);
    }
}
