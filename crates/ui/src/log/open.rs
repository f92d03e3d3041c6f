//! The log that is open, as far as the page knows it.

use std::collections::BTreeMap;

use pilotage_core::flight::interpret::Role;
use pilotage_core::flight::log::Outline;
use pilotage_core::flight::overview::Overview;

use crate::jobs::{LogSeries, SeriesName};
use crate::views::Pyramid;

/// A field over time, ready to be drawn at any width.
#[derive(Clone, Debug)]
pub struct PlottedSeries {
    /// Unit as the log states it, or empty.
    pub unit: String,
    /// Seconds in the log's time base, not going back.
    pub times: Vec<f64>,
    /// What every value is told against: values of small changes around a large number keep their digits.
    pub base: f64,
    values: Pyramid,
}

impl PlottedSeries {
    /// Takes over what a worker sent; in order of time, where the file was not.
    pub fn new(series: &LogSeries) -> Self {
        let mut samples: Vec<(f64, f64)> = series.samples().filter(|s| s.0.is_finite()).collect();
        if samples.windows(2).any(|pair| pair[1].0 < pair[0].0) {
            samples.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        let finite = samples.iter().map(|s| s.1).find(|v| v.is_finite());
        let base = finite.unwrap_or(0.0);
        let mut values = Pyramid::default();
        for (_, value) in &samples {
            values.push((value - base) as f32);
        }
        Self {
            unit: series.unit.clone(),
            times: samples.into_iter().map(|s| s.0).collect(),
            base,
            values,
        }
    }

    /// Values less the base.
    pub(crate) fn values(&self) -> &Pyramid {
        &self.values
    }

    /// The last value at or before `time`.
    pub fn at(&self, time: f64) -> Option<f64> {
        let after = self.times.partition_point(|t| *t <= time);
        let value = self.values.get(after.checked_sub(1)?)?;
        Some(self.base + f64::from(value))
    }
}

/// The log that is open.
#[derive(Clone, Debug, Default)]
pub struct OpenLog {
    /// Key of its files.
    pub key: String,
    /// Its name among them.
    pub file: String,
    /// What it holds, as far as it was read.
    pub outline: Option<Outline>,
    /// The flight at a glance, once all of it was read.
    pub overview: Option<Overview>,
    /// Why it cannot be navigated, if it cannot.
    pub unnavigable: Option<String>,
    /// Fields that have arrived.
    pub series: BTreeMap<SeriesName, PlottedSeries>,
    /// Another number whenever a field arrives.
    pub revision: u64,
}

impl OpenLog {
    /// A log of which nothing is known yet.
    pub fn new(key: String, file: String) -> Self {
        Self {
            key,
            file,
            ..Self::default()
        }
    }

    /// Whether all of it was read.
    pub fn is_read(&self) -> bool {
        self.overview.is_some()
    }

    /// A field has arrived.
    pub fn take(&mut self, series: &LogSeries) {
        self.revision += 1;
        self.series
            .insert(series.name.clone(), PlottedSeries::new(series));
    }

    /// First and last time, seconds.
    pub fn span(&self) -> Option<(f64, f64)> {
        self.outline.as_ref()?.span
    }

    /// The fields that a newcomer wants to see: height, speeds and attitude, as far as they were measured.
    pub fn first_fields(&self) -> Vec<Vec<SeriesName>> {
        let Some(overview) = &self.overview else {
            return Vec::new();
        };
        let is_alive = |role: Role| {
            let sensor = overview.sensors.iter().find(|s| s.role == role);
            sensor.is_some_and(|sensor| !sensor.is_dead)
        };
        let groups: [&[Role]; 3] = [
            &[Role::BarometricHeight, Role::HeightAboveGround],
            &[Role::Airspeed, Role::GroundSpeed],
            &[Role::Roll, Role::Pitch],
        ];
        let of = |roles: &[Role]| {
            let alive = roles.iter().copied().filter(|role| is_alive(*role));
            alive.map(SeriesName::role).collect::<Vec<_>>()
        };
        let panels = groups.into_iter().map(of);
        panels.filter(|fields| !fields.is_empty()).collect()
    }
}
