//! Readings of channels, thinned until their errors have nothing in common.

use nalgebra::DVector;

use super::aid::{AidInfo, AidLook, AidMoment, AidNumber};

/// Tolerance of times, seconds.
const SAME_TIME: f64 = 1e-6;

/// Number that every aid has whose errors last.
pub const APART: AidNumber = AidNumber {
    key: "apart",
    label: "Time between readings",
    unit: "s",
    usual: 1.0,
};

/// Least time between two that are taken, seconds: errors that last longer than that would count as many.
pub struct Spacing {
    apart: f64,
    last: f64,
}

impl Spacing {
    /// Nothing taken yet.
    pub const fn of(apart: f64) -> Self {
        Self {
            apart,
            last: f64::NEG_INFINITY,
        }
    }

    /// Whether one at `time` is far enough from the last.
    pub fn allows(&self, time: f64) -> bool {
        time >= self.last + self.apart - SAME_TIME
    }

    /// Notes that one at `time` is taken.
    pub const fn note(&mut self, time: f64) {
        self.last = time;
    }

    /// The look of a moment if it is far enough from the last that was taken; it is taken then.
    pub fn look<'m, 'a>(&mut self, moment: &'m AidMoment<'a>) -> Option<&'m AidLook<'a>> {
        let look = moment.look.as_ref().filter(|_| self.allows(moment.until))?;
        self.note(moment.until);
        Some(look)
    }
}

/// Readings of an aid's channels.
pub struct AidReadings {
    info: &'static AidInfo,
    spacing: Spacing,
}

impl AidReadings {
    /// Those of the channels of `info`, at least `apart` seconds from each other.
    pub fn of(info: &'static AidInfo, apart: f64) -> Self {
        Self {
            info,
            spacing: Spacing::of(apart),
        }
    }

    /// Latest values of the channels in a moment, if there are any that are not too near the ones before.
    pub fn next(&mut self, moment: &AidMoment<'_>) -> Option<DVector<f64>> {
        let first = moment.flight.channel(*self.info.channels.first()?)?;
        let end = first
            .times
            .partition_point(|t| *t <= moment.until + SAME_TIME);
        let time = *first.times.get(end.checked_sub(1)?)?;
        if time <= moment.from + SAME_TIME || !self.spacing.allows(time) {
            return None;
        }
        let values = self.info.channels.iter();
        let values: Option<Vec<f64>> = values
            .map(|name| moment.flight.value(*name, time))
            .collect();
        let values = values.filter(|values| values.iter().all(|value| value.is_finite()))?;
        self.spacing.note(time);
        Some(DVector::from_vec(values))
    }
}
