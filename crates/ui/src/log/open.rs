//! The log that is open, as far as the page knows it.

use std::collections::BTreeMap;

use pilotage_core::flight::interpret::Role;
use pilotage_core::flight::log::LogOutline;
use pilotage_core::flight::overview::Overview;
use pilotage_core::frames::LocalFrame;

use super::SpanFigures;
use crate::short_map::ShortMap;
use crate::units::shown_unit;
use crate::views::ExtentPyramid;
use pilotage_jobs::{LogSeries, RecordedPlaces, SeriesName};

/// Fields that a newcomer wants to see, plot by plot: those that are likely, and what takes their place where the
/// log has none of them.
const FIRST_FIELDS: [[&[Role]; 2]; 3] = [
    [
        &[Role::BarometricHeight, Role::HeightAboveGround],
        &[Role::GpsHeight],
    ],
    [&[Role::Airspeed, Role::GroundSpeed], &[]],
    [&[Role::Roll, Role::Pitch], &[]],
];

/// A field over time, as far as it has come, ready to be drawn at any width.
#[derive(Clone, Debug, Default)]
pub struct PlottedSeries {
    /// Unit as the log states it, or empty.
    pub unit: String,
    /// Seconds in the log's time base, not going back.
    pub times: Vec<f64>,
    /// Base that is subtracted from every value: values of small changes around a large number keep their
    /// digits.
    pub base: f64,
    /// Why the log has no such field, if it has none.
    pub lacks: Option<String>,
    /// Samples that there will be.
    total: usize,
    /// Replacement of the series once it is as long: the same field after more of the log was read.
    coming: Option<Box<Self>>,
    values: ExtentPyramid,
}

impl PlottedSeries {
    /// Takes over the first of what a worker sends, or what comes next.
    pub fn take(&mut self, piece: &LogSeries) {
        if piece.first == 0 && !self.times.is_empty() {
            self.coming = Some(Box::default());
        }
        if let Some(mut coming) = self.coming.take() {
            coming.take(piece);
            if coming.times.len() >= self.times.len() || coming.is_whole() {
                *self = *coming;
            } else {
                self.coming = Some(coming);
            }
            return;
        }
        if piece.first == 0 {
            *self = Self {
                unit: shown_unit(&piece.unit),
                times: Vec::with_capacity(piece.total),
                base: piece.base,
                lacks: piece.lacks.clone(),
                total: piece.total,
                ..Self::default()
            };
        }
        if piece.first == self.times.len() {
            self.times.extend(piece.samples().map(|(time, _)| time));
            self.values.extend(piece.samples().map(|(_, value)| value));
        }
    }

    /// Whether all of it has come.
    pub fn is_whole(&self) -> bool {
        self.times.len() == self.total
    }

    /// Values less the base.
    pub(crate) fn values(&self) -> &ExtentPyramid {
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
    /// Outline of the log, as far as it was read.
    pub outline: Option<LogOutline>,
    /// The flight at a glance, once all of it was read.
    pub overview: Option<Overview>,
    /// Tracks beside that of the flight, and the world frame that they are in.
    pub tracks: (Vec<RecordedPlaces>, Option<LocalFrame>),
    /// Fields that have arrived.
    pub series: BTreeMap<SeriesName, PlottedSeries>,
    /// Amount of the log that was read when a field was looked for last: the count of outlines.
    looked_for: ShortMap<SeriesName, u64>,
    /// Counts outlines.
    outlines: u64,
    /// Figures of the plotted fields over a span of time.
    pub figures: SpanFigures,
    /// Another number whenever samples of a field arrive.
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

    /// More of it was read.
    pub fn grow(&mut self, outline: LogOutline) {
        self.outline = Some(outline);
        self.outlines += 1;
    }

    /// Whether a field was looked for in all that was read of the log.
    pub fn is_up_to_date(&self, series: &SeriesName) -> bool {
        self.looked_for.get(series) == Some(&self.outlines)
    }

    /// A field is being looked for in what was read by now.
    pub fn look_for(&mut self, series: &SeriesName) {
        self.looked_for.insert(series.clone(), self.outlines);
    }

    /// Samples of a field have arrived.
    pub fn take(&mut self, piece: &LogSeries) {
        self.revision += 1;
        let series = self.series.entry(piece.name.clone()).or_default();
        series.take(piece);
    }

    /// First and last time, seconds.
    pub fn span(&self) -> Option<(f64, f64)> {
        self.outline.as_ref()?.span
    }

    /// Fields that [`Self::first_fields`] may return, before it is known what was measured.
    pub fn likely_fields() -> Vec<Vec<SeriesName>> {
        let of = |roles: &[Role]| roles.iter().copied().map(SeriesName::role).collect();
        FIRST_FIELDS
            .into_iter()
            .map(|[likely, _]| of(likely))
            .collect()
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
        let of = |roles: &[Role]| {
            let alive = roles.iter().copied().filter(|role| is_alive(*role));
            alive.map(SeriesName::role).collect::<Vec<_>>()
        };
        let panels = FIRST_FIELDS.into_iter().filter_map(|choices| {
            let mut choices = choices.into_iter().map(of);
            choices.find(|fields| !fields.is_empty())
        });
        panels.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::pairs::tests::field;
    use super::*;
    use pilotage_core::flight::log::{Log, LogFormat};

    /// Samples a second apart.
    fn each_second(values: &[f64]) -> PlottedSeries {
        field((0..values.len()).map(|i| (i as f64, values[i])))
    }

    #[test]
    fn a_field_that_begins_with_zeros_keeps_the_digits_of_the_rest() {
        let latitudes = [
            47.397_742_0,
            47.397_742_5,
            47.397_743_0,
            47.397_745_0,
            47.397_748_0,
        ];
        let values = [&[0.0; 7], &latitudes[..]].concat();
        let series = each_second(&values);
        assert_eq!(series.at(0.0), Some(0.0));
        for (i, latitude) in latitudes.iter().enumerate() {
            let shown = series.at(7.0 + i as f64).unwrap();
            assert!((shown - latitude).abs() < 1e-9, "{shown} of {latitude}");
        }
    }

    #[test]
    fn times_in_microseconds_after_a_zero_stay_apart() {
        let stamps = (0..600_u32).map(|i| 1.6e15 + 1e6 * f64::from(i));
        let values: Vec<f64> = std::iter::once(0.0).chain(stamps).collect();
        let series = each_second(&values);
        for (i, stamp) in values.iter().enumerate() {
            // Half a unit in the last place of single precision for a difference of 300 to 434 seconds is 16 µs.
            let shown = series.at(i as f64).unwrap();
            assert!((shown - stamp).abs() <= 16.0, "{shown} of {stamp}");
        }
    }

    #[test]
    fn a_field_is_looked_for_again_once_more_was_read() {
        let mut log = OpenLog::new("key".into(), "a.bin".into());
        let roll = SeriesName::role(Role::Roll);
        let outline = || LogOutline::of(&Log::new("a.bin", LogFormat::Dataflash));
        log.grow(outline());
        assert!(!log.is_up_to_date(&roll));
        log.look_for(&roll);
        assert!(log.is_up_to_date(&roll));
        log.grow(outline());
        assert!(!log.is_up_to_date(&roll));
    }
}
