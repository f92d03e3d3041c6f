//! Questions about a log, and their answers.

use pilotage_core::flight::SpanStatistics;
use pilotage_core::flight::log::LogOutline;
use pilotage_core::flight::overview::Overview;
use pilotage_core::frames::{GroundPoint, LocalFrame};
use serde::{Deserialize, Serialize};

use super::{SeriesName, whole_bytes};

/// Something to find out about a log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LogOrder {
    /// Key of the files.
    pub key: String,
    /// Name of the log among them.
    pub file: String,
    /// Of which series, each with its name for people.
    pub series: Vec<(SeriesName, String)>,
    /// From when to when, seconds in the log's time base, both included.
    pub span: (f64, f64),
    /// Question about the series.
    pub question: LogQuestion,
}

/// Question about series of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum LogQuestion {
    /// Figures of each series: answers `Statistics`, one by one.
    Statistics,
    /// A table of comma-separated values: answer `Table`.
    Table,
}

/// Answer to a question about a log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum LogAnswer {
    /// Figures of a series: none if it has no number in the span, or why there is no such series.
    Statistics(SeriesName, Result<Option<SpanStatistics>, String>),
    /// A table.
    Table {
        /// Comma-separated values with a heading.
        #[serde(with = "whole_bytes")]
        text: Vec<u8>,
        /// Why series are not in it, of those that are not.
        lacks: Vec<String>,
    },
}

/// A track of the log beside that of the flight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordedPlaces {
    /// Whose it is, for people.
    pub name: String,
    /// Its places in the order of time, metres in the world frame of the flight.
    pub places: Vec<GroundPoint>,
}

/// Content of a log when all of it was read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReadLog {
    /// Outline of the log.
    pub outline: LogOutline,
    /// The flight at a glance.
    pub overview: Overview,
    /// The world frame on the globe of the flight that it tells of, or why it tells of none. The flight stays
    /// where it is navigated: that of a long log is large.
    pub flight: Result<Option<LocalFrame>, String>,
    /// Tracks beside that of the flight: the autopilot's own estimate, and those of other vehicles.
    pub tracks: Vec<RecordedPlaces>,
    /// Why the pictures beside it are not part of that.
    pub lost_pictures: Option<String>,
}
