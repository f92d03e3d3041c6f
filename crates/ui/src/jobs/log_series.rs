//! Series of a log: by their names in it, by what they mean, or computed from others; sent piece by piece.

use std::collections::VecDeque;
use std::rc::Rc;

use pilotage_core::flight::expression::{Expression, Samples, SeriesSource as _};
use pilotage_core::flight::interpret::Role;
use pilotage_core::flight::log::{Log, TopicName};
use serde::{Deserialize, Serialize};

use super::running::slice;
use super::{Advance, JobEvent, RunningJob, Workshop, whole_bytes};

/// Samples sent at a time: what the page takes over in a small part of a frame.
const PIECE: usize = 1 << 17;
/// Bytes of a sample in a message: its time and its value.
const SAMPLE: usize = 12;
/// Samples that are kept at most, for those who ask for the same series again.
const MOST_KEPT: usize = 1 << 24;

/// Which series of a log.
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

/// A series of a log in order of time.
///
/// # Errors
/// Why the log has no such series, in words.
pub fn samples(log: &Log, name: &SeriesName) -> Result<Samples, String> {
    let lacks = |what: &str| format!("{}: there is no {what}", log.name);
    if name.is_expression() {
        let values = Expression::parse(&name.field).and_then(|it| it.evaluate(log));
        return values.map_err(|error| format!("{}: {error}", name.field));
    }
    if name.topic == SeriesName::role_topic() {
        let found = log.samples(&name.field);
        return found.ok_or_else(|| lacks(&name.field.to_lowercase()));
    }
    let full = format!("{}.{}", name.topic, name.field);
    let topic = log.topic(&name.topic).ok_or_else(|| lacks(&full))?;
    let field = topic.field(&name.field).filter(|f| f.kind.is_number());
    let field = field.ok_or_else(|| lacks(&full))?;
    let values = topic.rows.iter().map(|row| field.value(row));
    let samples = topic.times.iter().copied();
    let samples = samples.zip(values.map(|value| value.unwrap_or(f64::NAN)));
    Ok(Samples::in_order(samples, field.unit.clone()))
}

/// Series that were asked for last.
#[derive(Default)]
pub struct KeptSamples {
    /// The one asked for last at the end.
    kept: VecDeque<(SeriesName, Rc<Samples>)>,
}

impl KeptSamples {
    /// Keeps nothing any more.
    pub fn clear(&mut self) {
        self.kept.clear();
    }

    /// The series as it was kept, else as `make` makes it.
    pub fn get(
        &mut self,
        name: &SeriesName,
        make: impl FnOnce() -> Result<Samples, String>,
    ) -> Result<Rc<Samples>, String> {
        let place = self.kept.iter().position(|(kept, _)| kept == name);
        if let Some(found) = place.and_then(|place| self.kept.remove(place)) {
            let samples = found.1.clone();
            self.kept.push_back(found);
            return Ok(samples);
        }
        let samples = Rc::new(make()?);
        self.kept.push_back((name.clone(), samples.clone()));
        let count = |kept: &VecDeque<(_, Rc<Samples>)>| -> usize {
            kept.iter().map(|(_, samples)| samples.times.len()).sum()
        };
        while count(&self.kept) > MOST_KEPT {
            self.kept.pop_front();
        }
        Ok(samples)
    }
}

/// Samples of a field, in order of time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LogSeries {
    /// Which field.
    pub name: SeriesName,
    /// Unit as the log states it, or empty.
    pub unit: String,
    /// What every value is told against: values of small changes around a large number keep their digits.
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
    /// Some samples of a series.
    pub fn piece(name: &SeriesName, all: &Samples, first: usize, count: usize) -> Self {
        let base = all.values.iter().copied().find(|value| value.is_finite());
        let base = base.unwrap_or(0.0);
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
    fn lacking(name: &SeriesName, why: String) -> Self {
        Self {
            lacks: Some(why),
            ..Self::piece(name, &Samples::default(), 0, 0)
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

/// A series that is being sent: events `LogSeries`.
pub struct SendSeries {
    key: String,
    file: String,
    series: SeriesName,
    samples: Option<Rc<Samples>>,
    sent: usize,
}

impl SendSeries {
    /// Nothing sent yet.
    pub fn new(key: String, file: String, series: SeriesName) -> Self {
        Self {
            key,
            file,
            series,
            samples: None,
            sent: 0,
        }
    }
}

impl RunningJob for SendSeries {
    fn advance(
        &mut self,
        workshop: &mut Workshop,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let Some(samples) = &self.samples else {
            match workshop.samples(&self.key, &self.file, &self.series)? {
                Ok(samples) => self.samples = Some(samples),
                Err(why) => {
                    let lacking = LogSeries::lacking(&self.series, why);
                    emit(JobEvent::LogSeries(Box::new(lacking)));
                    emit(JobEvent::Finished);
                    return Ok(Advance::Done);
                }
            }
            return Ok(Advance::More);
        };
        let is_more = slice(clock, || {
            let piece = LogSeries::piece(&self.series, samples, self.sent, PIECE);
            emit(JobEvent::LogSeries(Box::new(piece)));
            self.sent += PIECE;
            self.sent < samples.times.len()
        });
        if is_more {
            return Ok(Advance::More);
        }
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}
