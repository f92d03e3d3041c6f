//! Requests to the workers about logs, as far as they have come.

use std::collections::HashMap;

use pilotage_core::mission::Mission;

use crate::log::SpanFigures;
use pilotage_jobs::{JobId, MapSource, SeriesName};

/// A log being read.
#[derive(Debug)]
pub(super) struct ReadingLog {
    pub id: JobId,
    /// Key of its files, and its name among them.
    pub key: String,
    pub file: String,
    /// Progress of the reading, 0 to 1.
    pub progress: f32,
    /// Present activity of the reading, in words.
    pub words: String,
    /// The map to fly over, where that is known already.
    pub map: Option<MapSource>,
    /// The mission to fly with, where there is one.
    pub mission: Option<Mission>,
    /// Whether it was open before, so that the mission that is open then is its own.
    pub is_again: bool,
    /// Whether the page shows it already.
    pub is_shown: bool,
}

/// Requests to the workers about logs.
#[derive(Debug, Default)]
pub(super) struct LogWork {
    /// The log being read.
    pub reading: Option<ReadingLog>,
    /// Fields being fetched.
    pub fetching: HashMap<JobId, SeriesName>,
    /// Whether the worker that had the log is gone.
    pub lost: bool,
    /// Other requests about the log: figures and tables.
    pub answers: LogAnswers,
    /// Number of times that the open log was read again for these requests.
    pub rereads: u8,
}

impl LogWork {
    /// Whether a job is about a log.
    pub fn has(&self, id: JobId) -> bool {
        let is_reading = self.reading.as_ref().is_some_and(|r| r.id == id);
        is_reading || self.fetching.contains_key(&id) || self.answers.has(id)
    }
}

/// Fields and span of the figures that were asked for last.
#[derive(Debug, PartialEq)]
pub(super) struct Asked {
    pub fields: Vec<SeriesName>,
    pub span: (f64, f64),
}

/// A table being written.
#[derive(Debug)]
pub(super) struct Table {
    pub id: JobId,
    /// Name of the file that it becomes.
    pub name: String,
    pub progress: f32,
}

/// Requests about a log beside its series.
#[derive(Debug, Default)]
pub(super) struct LogAnswers {
    pub asked: Option<Asked>,
    pub figures: Option<(JobId, SpanFigures)>,
    pub table: Option<Table>,
}

impl LogAnswers {
    /// Whether a job is one of these.
    pub fn has(&self, id: JobId) -> bool {
        self.figures.as_ref().is_some_and(|(job, _)| *job == id)
            || self.table.as_ref().is_some_and(|table| table.id == id)
    }

    /// Progress of a table, 0 to 1, and its words.
    pub fn table_progress(&self) -> Option<(f32, &str)> {
        let table = self.table.as_ref()?;
        Some((table.progress, "Writing the table"))
    }
}
