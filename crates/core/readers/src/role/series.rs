//! Series measured of a role.

use super::Role;
use crate::times::{TimeVerdict, judge};
use pilotage_base::frames::wrap_pi;

/// A role found in a log.
#[derive(Clone, Debug, PartialEq)]
pub struct RoleSeries {
    /// The role.
    pub role: Role,
    /// Topic and field, as people know them: `ATT.Yaw`.
    pub source: String,
    /// Seconds in the log's time base, growing.
    pub times: Vec<f64>,
    /// Values in SI and radians, one per time.
    pub values: Vec<f64>,
    /// Samples left out because they are no number or beyond anything that flies.
    pub implausible: usize,
    /// Samples left out because their time stands still, goes back or lies far off.
    pub out_of_order: usize,
    /// Whether something holds it still, as a gimbal holds a camera: one number over and over is no fault then.
    pub is_held: bool,
}

impl RoleSeries {
    /// The samples of a role, times in seconds and values in SI and radians, without those that cannot be.
    /// Empty if none is left.
    pub fn new(
        role: Role,
        source: impl Into<String>,
        samples: impl IntoIterator<Item = (f64, Option<f64>)>,
    ) -> Self {
        let samples = samples.into_iter();
        let count = samples.size_hint().0;
        let mut series = Self {
            role,
            source: source.into(),
            times: Vec::with_capacity(count),
            values: Vec::with_capacity(count),
            implausible: 0,
            out_of_order: 0,
            is_held: false,
        };
        let (plausible, wraps) = (role.plausible(), role.is_angle());
        for (time, value) in samples {
            let value = value.filter(|v| v.is_finite() && v.abs() <= plausible);
            let Some(value) = value.filter(|_| time.is_finite()) else {
                series.implausible += 1;
                continue;
            };
            series.times.push(time);
            series
                .values
                .push(if wraps { wrap_pi(value) } else { value });
        }
        series.leave_out_of_order();
        series
    }

    /// Leaves out samples whose time is not sound or stands still.
    fn leave_out_of_order(&mut self) {
        let verdicts = judge(&self.times);
        if verdicts.is_none() && self.times.windows(2).all(|w| w[1] > w[0]) {
            return;
        }
        let mut last = f64::NEG_INFINITY;
        let is_kept = |(row, time): (usize, &f64)| {
            let is_sound = verdicts
                .as_ref()
                .is_none_or(|v| v[row] == TimeVerdict::Sound);
            let is_kept = is_sound && *time > last;
            if is_kept {
                last = *time;
            }
            is_kept
        };
        let kept: Vec<bool> = self.times.iter().enumerate().map(is_kept).collect();
        for series in [&mut self.times, &mut self.values] {
            let mut kept = kept.iter().copied();
            series.retain(|_| kept.next().unwrap_or(true));
        }
        self.out_of_order += kept.iter().filter(|kept| !**kept).count();
    }

    /// Whether it is the autopilot's own estimate among `found`, which stands in for what a receiver would measure.
    pub fn stands_in(&self, found: &[Self]) -> bool {
        let Some(own) = self.role.autopilots_own() else {
            return false;
        };
        found
            .iter()
            .any(|other| other.role == own && other.source == self.source)
    }

    /// The last value at or before `time`, or else the first; `None` without any.
    pub fn at(&self, time: f64) -> Option<f64> {
        let after = self.times.partition_point(|t| *t <= time + 1e-9);
        self.values.get(after.saturating_sub(1)).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_time_that_leaps_ahead_takes_only_its_own_sample() {
        let time = |i: u32| if i == 50 { 9e12 } else { 0.1 * f64::from(i) };
        let samples = (0..200).map(|i| (time(i), Some(1.0 + f64::from(i))));
        let series = RoleSeries::new(Role::Airspeed, "A.b", samples);
        assert_eq!((series.times.len(), series.out_of_order), (199, 1));
        assert!((series.times[198] - 19.9).abs() < 1e-9);
        // A step back is what is wrong itself.
        let time = |i: u32| if i == 50 { 1.0 } else { 0.1 * f64::from(i) };
        let samples = (0..200).map(|i| (time(i), Some(1.0)));
        let series = RoleSeries::new(Role::Airspeed, "A.b", samples);
        assert_eq!((series.times.len(), series.out_of_order), (199, 1));
    }
}
