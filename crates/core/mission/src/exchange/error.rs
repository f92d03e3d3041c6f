//! Errors of a file of routes or landmarks.

use crate::mission::MissionError;

/// Why a file cannot be read or written, with the file, the place in it and what to do.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ExchangeError {
    /// Neither content nor extension tell a format that is known.
    #[error(
        "{file}: this is no file of routes or landmarks; known are QGroundControl .plan, QGC WPL .waypoints, KML, KMZ, DJI's WPML, GeoJSON, GPX and CSV"
    )]
    Unknown {
        /// Name of the file.
        file: String,
    },
    /// Something is wrong at a place of the text.
    #[error("{file}, line {line}, column {column}: {cause}")]
    Place {
        /// Name of the file.
        file: String,
        /// Line, counted from one.
        line: usize,
        /// Column, counted from one.
        column: usize,
        /// Error in words, and for a nested file the member or element that has it.
        cause: String,
    },
    /// Something is wrong with the file as a whole.
    #[error("{file}: {cause}")]
    File {
        /// Name of the file.
        file: String,
        /// Error in words, and its remedy.
        cause: String,
    },
    /// Contents that have no place in the format.
    #[error("{format} cannot hold {what}; {advice}")]
    CannotHold {
        /// Name of the format.
        format: &'static str,
        /// Contents that it cannot hold.
        what: String,
        /// Advice about another way.
        advice: &'static str,
    },
}

impl ExchangeError {
    /// The complaint of a reader of JSON, about `file`.
    pub(super) fn of_json(file: &str, error: MissionError) -> Self {
        match error {
            MissionError::Json {
                line,
                column,
                cause,
            } => Self::Place {
                file: file.to_owned(),
                line,
                column,
                cause,
            },
            other => Self::File {
                file: file.to_owned(),
                cause: other.to_string(),
            },
        }
    }
}
