//! Errors of a flight folder.

/// Why a flight folder cannot be read, with the file and the place in it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FolderError {
    /// There is no flight.json.
    #[error("there is no flight.json among the files")]
    NoFlightFile,
    /// A file that is referred to is not there.
    #[error("{file} is missing; {wanted_by} refers to it")]
    Missing {
        /// Name of the missing file.
        file: String,
        /// Place that refers to it.
        wanted_by: String,
    },
    /// Several files could be meant.
    #[error("{file} could be {first} or {second}; state its path in flight.json")]
    Ambiguous {
        /// Name as it is referred to.
        file: String,
        /// File that could be meant.
        first: String,
        /// Another.
        second: String,
    },
    /// A JSON file is malformed or has an unknown or missing member.
    #[error("{file}, line {line}, column {column}: {cause}")]
    Json {
        /// File.
        file: String,
        /// Line, counted from one.
        line: usize,
        /// Column, counted from one.
        column: usize,
        /// Error of the file, in words.
        cause: String,
    },
    /// A table does not have a column that the column map names.
    #[error("{file}, line 1: there is no column \"{column}\"; it has {present}")]
    NoColumn {
        /// File.
        file: String,
        /// Column that is looked for.
        column: String,
        /// Columns that there are.
        present: String,
    },
    /// A cell of a table cannot be understood.
    #[error("{file}, line {line}, column \"{column}\": {cause}")]
    Cell {
        /// File.
        file: String,
        /// Line, counted from one.
        line: u64,
        /// Name of the column.
        column: String,
        /// Error of the cell, in words.
        cause: String,
    },
    /// A file as a whole cannot be understood.
    #[error("{file}: {cause}")]
    File {
        /// File.
        file: String,
        /// Error of the file, in words.
        cause: String,
    },
    /// A statement of flight.json contradicts itself or another.
    #[error("{file}, {place}: {cause}")]
    Contents {
        /// File.
        file: String,
        /// Member.
        place: String,
        /// Error of the statement, and its remedy.
        cause: String,
    },
}

impl FolderError {
    /// Error of the JSON reader, with the place in front instead of at the end.
    pub(super) fn json(file: &str, error: &serde_json::Error) -> Self {
        let text = error.to_string();
        let cause = text
            .rfind(" at line ")
            .map_or(text.as_str(), |i| &text[..i]);
        Self::Json {
            file: file.to_owned(),
            line: error.line(),
            column: error.column(),
            cause: cause.to_owned(),
        }
    }
}
