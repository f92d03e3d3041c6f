//! MATLAB's files of version 4 to 7 (`.mat`), read as the tables that their variables are.
//!
//! The layout is that of "MAT-File Format" of `MathWorks`, chapter 1: elements of a tag and data, compressed ones within
//! elements of their own. Files of version 7.3 are HDF5 and are refused with a word of what to do.

mod element;
mod fourth;
mod tables;
#[cfg(test)]
mod tests;
mod value;

use std::collections::BTreeMap;

use pilotage_base::files::FileSet;

/// Ending of such files.
pub const ENDING: &str = "mat";

/// Why a file is none that can be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MatError {
    /// Something else than such a file.
    #[error("{0}: this is no MATLAB file of version 4 to 7")]
    Other(String),
    /// HDF5.
    #[error("{0}: this MATLAB file is of version 7.3; save it with save(…, '-v7')")]
    Newer(String),
    /// No variable in it is a table.
    #[error(
        "{0}: no variable in it is a table of numbers; save matrices, or structures whose fields are columns \
             (`s = table2struct(t, 'ToScalar', true)` of a table)"
    )]
    Empty(String),
    /// Nothing but variables that are too large.
    #[error("{0}")]
    TooLarge(String),
    /// It is cut off or damaged.
    #[error(
        "{0}: it is cut off or damaged behind {1}; copy it again, or save it anew where it was made"
    )]
    Damaged(String, String),
}

/// The tables in a MATLAB file: a matrix each, columns of equal length together, a structure's fields.
#[derive(Clone, Debug, Default)]
pub struct MatFiles {
    tables: BTreeMap<String, Vec<u8>>,
    left_out: Vec<String>,
}

impl MatFiles {
    /// Reads the file that is called `name`. Variables of a kind that is no table are left out, and, with a sentence, those that
    /// are too large.
    ///
    /// # Errors
    /// It is no such file, is damaged, or has no table.
    pub fn open(name: &str, bytes: &[u8]) -> Result<Self, MatError> {
        Self::open_within(name, bytes, element::MOST)
    }

    /// The same, without variables of `most` bytes or more once they are unpacked.
    fn open_within(name: &str, bytes: &[u8], most: u64) -> Result<Self, MatError> {
        let named = name;
        let name = || named.to_owned();
        if bytes.starts_with(b"MATLAB 7.3") {
            return Err(MatError::Newer(name()));
        }
        let variables = value::variables(bytes, most).or_else(|| fourth::variables(bytes));
        let variables = variables.ok_or_else(|| MatError::Other(name()))?;
        if variables.is_damaged {
            let last = variables.all.last();
            let behind = last.map_or("its beginning", |(name, _)| name.as_str());
            return Err(MatError::Damaged(name(), behind.to_owned()));
        }
        let left_out = variables.too_large.iter().map(|variable| {
            format!(
                "{named}: {variable} was left out, as it is larger than 1 GiB once it is unpacked; save it in a file of its own, \
                 in parts"
            )
        });
        let left_out: Vec<String> = left_out.collect();
        let variables = variables.all;
        let stem = name();
        let stem = stem.strip_suffix(".mat").unwrap_or(&stem);
        let tables = tables::of(stem, &variables);
        match (tables.is_empty(), left_out.is_empty()) {
            (true, true) => Err(MatError::Empty(name())),
            (true, false) => Err(MatError::TooLarge(left_out.join("; "))),
            _ => Ok(Self { tables, left_out }),
        }
    }
}

impl FileSet for MatFiles {
    fn names(&self) -> Vec<String> {
        self.tables.keys().cloned().collect()
    }

    fn read(&self, name: &str) -> Option<Vec<u8>> {
        self.tables.get(name).cloned()
    }

    fn left_out(&self) -> Vec<String> {
        self.left_out.clone()
    }
}
