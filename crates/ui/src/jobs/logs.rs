//! Flight logs: read piece by piece, kept by the worker, and asked for their series.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use pilotage_core::flight::Flight;
use pilotage_core::flight::files::FileSet as _;
use pilotage_core::flight::interpret::{Role, flight_from_log, series};
use pilotage_core::flight::log::{HEAD, Log, LogReader, Outline, TopicName, read_log, recognise};
use pilotage_core::flight::overview::{Overview, overview};
use pilotage_core::imagery::ByteSource;
use serde::{Deserialize, Serialize};

use super::file_pool::FilePool;
use super::flights::OpenFlight;
use super::running::slice;
use super::{Advance, JobEvent, RunningJob, Workshop, whole_bytes};

/// Bytes that are read at a time.
const PIECE: usize = 2 << 20;
/// Milliseconds after which what was read so far is told first; each time later twice as long.
const FIRST_WORD: f64 = 300.0;

/// What a log came to when all of it was read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReadLog {
    /// What it holds.
    pub outline: Outline,
    /// The flight at a glance.
    pub overview: Overview,
    /// The flight that it tells of, or why it tells of none.
    pub flight: Result<Flight, String>,
}

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

    /// The series of a role.
    pub fn role(role: Role) -> Self {
        Self {
            topic: Self::role_topic(),
            field: role.label().to_owned(),
        }
    }
}

/// The values of a field.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LogSeries {
    /// Which.
    pub name: SeriesName,
    /// Unit as the log states it, or empty.
    pub unit: String,
    /// Times and values by turns, each a double-precision number, lowest byte first.
    #[serde(with = "whole_bytes")]
    pairs: Vec<u8>,
}

impl LogSeries {
    /// What the log means by a role, under the name of a topic that no log has.
    fn of_role(log: &Log, name: SeriesName) -> Result<Self, String> {
        let lacks = || format!("{}: there is no {}", log.name, name.field.to_lowercase());
        let role = Role::from_label(&name.field).ok_or_else(lacks)?;
        let found = series(log, role).ok_or_else(lacks)?;
        let (unit, factor) = role.unit();
        let pairs = found.times.iter().zip(&found.values);
        let pairs = pairs.flat_map(|(time, value)| [*time, factor * value]);
        Ok(Self {
            unit: unit.to_owned(),
            name,
            pairs: pairs.flat_map(f64::to_le_bytes).collect(),
        })
    }

    /// The values of a field.
    fn of(log: &Log, name: SeriesName) -> Result<Self, String> {
        if name.topic == SeriesName::role_topic() {
            return Self::of_role(log, name);
        }
        let lacks = || format!("{}: there is no {}.{}", log.name, name.topic, name.field);
        let topic = log.topic(&name.topic).ok_or_else(lacks)?;
        let field = topic.field(&name.field).ok_or_else(lacks)?;
        let mut pairs = Vec::with_capacity(16 * topic.len());
        for (time, row) in topic.times.iter().zip(topic.rows.iter()) {
            let value = field.value(row).unwrap_or(f64::NAN);
            pairs.extend_from_slice(&time.to_le_bytes());
            pairs.extend_from_slice(&value.to_le_bytes());
        }
        Ok(Self {
            unit: field.unit.clone(),
            name,
            pairs,
        })
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.pairs.len() / 16
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    /// Times (seconds) and values, in the order of the file.
    pub fn samples(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let number = |bytes: &[u8]| bytes.try_into().map_or(f64::NAN, f64::from_le_bytes);
        let pairs = self.pairs.chunks_exact(16);
        pairs.map(move |pair| (number(&pair[..8]), number(&pair[8..])))
    }
}

/// The first log among files, by what is in it.
pub fn log_among(pool: &FilePool) -> Option<String> {
    let mut names = pool.names();
    names.sort();
    names.into_iter().find(|name| {
        let head = pool.source(name).and_then(|source| head(source.as_ref()));
        head.is_some_and(|head| recognise(&head).is_some())
    })
}

fn head(source: &dyn ByteSource) -> Option<Vec<u8>> {
    let length = HEAD.min(source.length() as usize);
    source.read(0, length).ok()
}

/// A log that is read.
struct Reading {
    source: Arc<dyn ByteSource>,
    reader: Box<dyn LogReader>,
    log: Rc<RefCell<Log>>,
    offset: u64,
}

impl Reading {
    fn begin(pool: &FilePool, file: &str) -> Result<Self, String> {
        let gone = || format!("{file}: it is not here any more; open it again");
        let source = pool.source(file).ok_or_else(gone)?;
        let head = head(source.as_ref()).unwrap_or_default();
        let info = recognise(&head).ok_or_else(|| format!("{file}: it is no flight log"))?;
        Ok(Self {
            source,
            reader: (info.reader)(),
            log: Rc::new(RefCell::new(Log::new(file, info.format))),
            offset: 0,
        })
    }

    /// Reads a piece; whether there are more.
    fn step(&mut self) -> Result<bool, String> {
        let left = self.source.length() - self.offset;
        let length = PIECE.min(usize::try_from(left).unwrap_or(PIECE));
        let mut log = self.log.borrow_mut();
        if length == 0 {
            self.reader.finish(&mut log);
            return Ok(false);
        }
        let bytes = self.source.read(self.offset, length);
        let bytes = bytes.map_err(|cause| format!("{}: {cause}", log.name))?;
        self.reader.feed(&bytes, &mut log);
        self.offset += length as u64;
        Ok(true)
    }

    fn share(&self) -> f32 {
        self.offset as f32 / self.source.length().max(1) as f32
    }
}

/// A log that is being read: events `Progress`, `LogOutline` as it grows, at the end `LogRead`.
pub struct ReadingLog {
    key: String,
    file: String,
    reading: Option<Reading>,
    begun: f64,
    /// When what was read so far is told next, milliseconds after the beginning.
    word: f64,
}

impl ReadingLog {
    /// Nothing read yet.
    pub fn new(key: String, file: String) -> Self {
        Self {
            key,
            file,
            reading: None,
            begun: 0.0,
            word: FIRST_WORD,
        }
    }
}

impl RunningJob for ReadingLog {
    fn advance(
        &mut self,
        workshop: &mut Workshop,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        if self.reading.is_none() {
            self.begun = clock();
            let reading = Reading::begin(workshop.files(&self.key)?.as_ref(), &self.file)?;
            workshop.keep_log(&self.key, &self.file, reading.log.clone());
            self.reading = Some(reading);
        }
        let Some(reading) = &mut self.reading else {
            return Ok(Advance::Done);
        };
        let mut trouble = None;
        let is_more = slice(clock, || match reading.step() {
            Ok(is_more) => is_more,
            Err(cause) => {
                trouble = Some(cause);
                false
            }
        });
        if let Some(cause) = trouble {
            return Err(cause);
        }
        if is_more {
            let words = format!("Reading {}", self.file);
            emit(JobEvent::Progress(reading.share(), words));
            if clock() - self.begun > self.word {
                self.word *= 2.0;
                let outline = Outline::of(&reading.log.borrow());
                emit(JobEvent::LogOutline(Box::new(outline)));
            }
            return Ok(Advance::More);
        }
        let log = reading.log.borrow();
        let interpreted = flight_from_log(&log);
        let read = ReadLog {
            outline: Outline::of(&log),
            overview: overview(&log, &interpreted),
            flight: interpreted.flight.map_err(|cause| cause.to_string()),
        };
        if let Ok(flight) = &read.flight {
            workshop.keep_flight(&self.key, OpenFlight::without_pictures(flight.clone()));
        }
        emit(JobEvent::LogRead(Box::new(read)));
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

/// The flight that the log among the files tells of; reads all of it at once.
pub fn flight_of_log(pool: &FilePool) -> Result<Option<OpenFlight>, String> {
    let Some(file) = log_among(pool) else {
        return Ok(None);
    };
    let source = pool.source(&file).ok_or("the log is gone")?;
    let blame = |cause: String| format!("{file}: {cause}");
    let Some(log) = read_log(source.as_ref()).map_err(blame)? else {
        return Ok(None);
    };
    let flight = flight_from_log(&log).flight;
    let flight = flight.map_err(|cause| cause.to_string())?;
    Ok(Some(OpenFlight::without_pictures(flight)))
}

/// The series `name` of the log `file` among the files under `key`.
pub fn log_series(
    workshop: &Workshop,
    key: &str,
    file: &str,
    name: SeriesName,
) -> Result<LogSeries, String> {
    let log = workshop.log(key, file);
    let log = log.ok_or_else(|| format!("{file}: it is not read yet"))?;
    LogSeries::of(&log.borrow(), name)
}

#[cfg(test)]
#[path = "logs_tests.rs"]
mod tests;
