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
}

impl MatFiles {
    /// Reads the file that is called `name`. Variables of a kind that is no table are left out.
    ///
    /// # Errors
    /// It is no such file, is damaged, or has no table.
    pub fn open(name: &str, bytes: &[u8]) -> Result<Self, MatError> {
        let name = || name.to_owned();
        if bytes.starts_with(b"MATLAB 7.3") {
            return Err(MatError::Newer(name()));
        }
        let variables = value::variables(bytes).or_else(|| fourth::variables(bytes));
        let variables = variables.ok_or_else(|| MatError::Other(name()))?;
        if variables.is_damaged {
            let last = variables.all.last();
            let behind = last.map_or("its beginning", |(name, _)| name.as_str());
            return Err(MatError::Damaged(name(), behind.to_owned()));
        }
        let variables = variables.all;
        let stem = name();
        let stem = stem.strip_suffix(".mat").unwrap_or(&stem);
        let tables = tables::of(stem, &variables);
        if tables.is_empty() {
            return Err(MatError::Empty(name()));
        }
        Ok(Self { tables })
    }
}

impl FileSet for MatFiles {
    fn names(&self) -> Vec<String> {
        self.tables.keys().cloned().collect()
    }

    fn read(&self, name: &str) -> Option<Vec<u8>> {
        self.tables.get(name).cloned()
    }
}
