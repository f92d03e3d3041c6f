//! Errors of a mission file.

/// Why a mission file cannot be read, with the place in it; the caller knows the file's name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MissionError {
    /// The bytes are not text.
    #[error("byte {0} is not UTF-8 text")]
    NotText(usize),
    /// The text is not JSON, or a member has the wrong type.
    #[error("line {line}, column {column}: {cause}")]
    Json {
        /// Line, counted from one.
        line: usize,
        /// Column, counted from one.
        column: usize,
        /// Error of the JSON, in words.
        cause: String,
    },
    /// It is JSON but no `FeatureCollection` of GeoJSON.
    #[error("line 1: this is not a GeoJSON FeatureCollection, which a mission file is")]
    NotAFeatureCollection,
    /// It was written by a later version.
    #[error("line {line}: version {version} of the mission file is not known; update the program")]
    Version {
        /// Line, counted from one.
        line: usize,
        /// Version in the file.
        version: String,
    },
}
