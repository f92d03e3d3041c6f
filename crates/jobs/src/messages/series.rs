//! Series of a log, by name and as they are sent.

use pilotage_core::flight::expression::TimedSamples;
use pilotage_core::flight::interpret::Role;
use pilotage_core::flight::log::TopicName;
use serde::{Deserialize, Serialize};

use super::whole_bytes;

/// Bytes of a sample in a message: its time and its value.
const SAMPLE: usize = 12;

/// Name of a series of a log.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct SeriesName {
    /// The topic.
    pub topic: TopicName,
    /// The field.
    pub field: String,
}

impl SeriesName {
    /// The topic under which roles are found, whatever the log calls them. No format writes a blank into a
    /// topic's name.
    pub fn role_topic() -> TopicName {
        TopicName::single("this flight")
    }

    /// The topic under which expressions over other series are found.
    pub fn expression_topic() -> TopicName {
        TopicName::single("an expression")
    }

    /// The series of a role.
    pub fn role(role: Role) -> Self {
        Self {
            topic: Self::role_topic(),
            field: role.label().to_owned(),
        }
    }

    /// The series that an expression over others gives.
    pub fn expression(text: &str) -> Self {
        Self {
            topic: Self::expression_topic(),
            field: text.trim().to_owned(),
        }
    }

    /// Whether it is computed from others.
    pub fn is_expression(&self) -> bool {
        self.topic == Self::expression_topic()
    }
}

/// Samples of a field, in order of time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LogSeries {
    /// Name of the series.
    pub name: SeriesName,
    /// Unit as the log states it, or empty.
    pub unit: String,
    /// Base that is subtracted from every value ([`Self::base_of`]): values of small changes around a large number
    /// keep their digits.
    pub base: f64,
    /// Number of the first of these samples.
    pub first: usize,
    /// Number of samples of the whole series.
    pub total: usize,
    /// Why there is no such series, if there is none.
    pub lacks: Option<String>,
    /// Times (double precision) and values less the base (single precision) by turns, lowest byte first.
    #[serde(with = "whole_bytes")]
    samples: Vec<u8>,
}

impl LogSeries {
    /// Base for all pieces of a series: the value in the middle, in single precision.
    ///
    /// A 0 stands for no reading in most logs (GPS before its fix) and is not asked: half a flight of them would be the
    /// middle. It stays exact with any base, as its difference is a number of single precision.
    pub fn base_of(all: &TimedSamples) -> f64 {
        let told = all.values.iter().map(|value| f64::from(*value as f32));
        let told = told.filter(|value| value.is_finite() && *value != 0.0);
        let mut told: Vec<f64> = told.collect();
        if told.is_empty() {
            return 0.0;
        }
        let middle = told.len() / 2;
        *told.select_nth_unstable_by(middle, f64::total_cmp).1
    }

    /// Some samples of a series, less a `base`.
    pub fn piece(
        name: &SeriesName,
        all: &TimedSamples,
        base: f64,
        first: usize,
        count: usize,
    ) -> Self {
        let end = (first + count).min(all.times.len());
        let mut samples = Vec::with_capacity(SAMPLE * (end - first));
        for (time, value) in all.times[first..end].iter().zip(&all.values[first..end]) {
            samples.extend_from_slice(&time.to_le_bytes());
            samples.extend_from_slice(&((value - base) as f32).to_le_bytes());
        }
        Self {
            name: name.clone(),
            unit: all.unit.clone(),
            base,
            first,
            total: all.times.len(),
            lacks: None,
            samples,
        }
    }

    /// That there is no such series.
    pub(crate) fn lacking(name: &SeriesName, why: String) -> Self {
        Self {
            lacks: Some(why),
            ..Self::piece(name, &TimedSamples::default(), 0.0, 0, 0)
        }
    }

    /// Number of samples in here.
    pub fn len(&self) -> usize {
        self.samples.len() / SAMPLE
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.samples.is_empty()
    }

    /// Times (seconds) and values less the base.
    pub fn samples(&self) -> impl Iterator<Item = (f64, f32)> + '_ {
        let sample = |bytes: &[u8]| {
            let time = bytes[..8].try_into().map_or(f64::NAN, f64::from_le_bytes);
            let value = bytes[8..].try_into().map_or(f32::NAN, f32::from_le_bytes);
            (time, value)
        };
        self.samples.chunks_exact(SAMPLE).map(sample)
    }
}
