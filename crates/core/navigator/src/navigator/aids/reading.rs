//! Readings of channels, thinned until their errors have nothing in common.

use nalgebra::DVector;

use super::aid::{AidInfo, AidMoment, AidNumber};

/// Tolerance of times, seconds.
const SAME_TIME: f64 = 1e-6;

/// Number that every aid has whose errors last.
pub const APART: AidNumber = AidNumber {
    key: "apart",
    label: "Time between readings",
    unit: "s",
    usual: 1.0,
};

/// Readings of an aid's channels.
pub struct AidReadings {
    info: &'static AidInfo,
    /// Least time between two that are taken, seconds: errors that last longer than that would count as many.
    apart: f64,
    last: f64,
}

impl AidReadings {
    /// Those of the channels of `info`, at least `apart` seconds from each other.
    pub fn of(info: &'static AidInfo, apart: f64) -> Self {
        Self {
            info,
            apart,
            last: f64::NEG_INFINITY,
        }
    }

    /// Latest values of the channels in a moment, if there are any that are not too near the ones before.
    pub fn next(&mut self, moment: &AidMoment<'_>) -> Option<DVector<f64>> {
        let first = moment.flight.channel(*self.info.channels.first()?)?;
        let end = first
            .times
            .partition_point(|t| *t <= moment.until + SAME_TIME);
        let time = *first.times.get(end.checked_sub(1)?)?;
        if time <= moment.from + SAME_TIME || time < self.last + self.apart - SAME_TIME {
            return None;
        }
        let values = self.info.channels.iter();
        let values: Option<Vec<f64>> = values
            .map(|name| moment.flight.value(*name, time))
            .collect();
        let values = values.filter(|values| values.iter().all(|value| value.is_finite()))?;
        self.last = time;
        Some(DVector::from_vec(values))
    }
}
