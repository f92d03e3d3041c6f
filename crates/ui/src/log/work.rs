//! The log as a feature: what is known of it, what is asked about it, how it is shown.

use pilotage_jobs::{JobId, SeriesName};

use super::{FieldList, LogPlots, LogTab, OpenLog, OwnPresets, SpanFigures};
use crate::feature::FlightFiles;

/// Log beside the run: read in a worker, its fields fetched when they are plotted.
#[derive(Default)]
pub struct LogFeature {
    /// The log that is open.
    pub(super) log: Option<OpenLog>,
    /// The log being read.
    pub(super) reading: Option<Reading>,
    /// Fields being fetched.
    pub(super) fetching: Vec<(JobId, SeriesName)>,
    /// Whether the worker that had the log is gone.
    pub(super) is_lost: bool,
    /// Number of times that the open log was read again because it was lost.
    pub(super) rereads: u8,
    /// Other requests about the log: figures and tables.
    pub(super) answers: LogAnswers,
    /// Tab in the column at the right.
    pub(super) tab: LogTab,
    pub(super) fields: FieldList,
    pub(super) plots: LogPlots,
    /// Whether the plots are those of the log, not of the run.
    pub(super) shows_plots: bool,
    pub(super) presets: OwnPresets,
    /// Arrangements as they are stored.
    pub(super) stored_presets: OwnPresets,
    /// Field by which the recorded track is coloured.
    pub(super) track_field: Option<SeriesName>,
}

/// A log being read.
#[derive(Debug)]
pub(super) struct Reading {
    pub job: JobId,
    /// Flight that it tells of.
    pub flight: FlightFiles,
    /// Progress of the reading, 0 to 1.
    pub progress: f32,
    /// Present activity of the reading, in words.
    pub words: String,
    /// Whether the page shows it already.
    pub is_shown: bool,
}

/// Fields and span of the figures that were asked for last.
#[derive(Debug, PartialEq)]
pub(super) struct AskedFigures {
    pub fields: Vec<SeriesName>,
    pub span: (f64, f64),
}

/// A table being written.
#[derive(Debug)]
pub(super) struct TableExport {
    pub job: JobId,
    /// Name of the file that it becomes.
    pub name: String,
    pub progress: f32,
}

/// Requests about a log beside its series.
#[derive(Debug, Default)]
pub(super) struct LogAnswers {
    pub asked: Option<AskedFigures>,
    pub figures: Option<(JobId, SpanFigures)>,
    pub table: Option<TableExport>,
}

impl LogAnswers {
    /// Whether a job is one of these.
    pub fn has(&self, id: JobId) -> bool {
        self.figures.as_ref().is_some_and(|(job, _)| *job == id)
            || self.table.as_ref().is_some_and(|table| table.job == id)
    }

    /// Waits no more for the table, or else for the figures, which are asked for again once the log was read again or
    /// others are wanted.
    pub fn leave(&mut self, is_table: bool) {
        if is_table {
            self.table = None;
        } else {
            self.figures = None;
        }
    }
}
