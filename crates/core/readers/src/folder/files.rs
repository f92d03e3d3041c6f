//! The files of a flight folder while it is read.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::error::FolderError;
use super::table::CsvTable;
use pilotage_base::files::{FileSet, Unresolved, find};

/// Name of the file that makes a folder a flight.
pub const FLIGHT_FILE: &str = "flight.json";

/// The files of a flight while it is read; each table is parsed once.
pub(super) struct FolderFiles {
    pub(super) files: Arc<dyn FileSet>,
    /// Folders in which names are looked up first.
    pub(super) folders: Vec<String>,
    pub(super) tables: BTreeMap<String, Arc<CsvTable>>,
    pub(super) notes: Vec<String>,
}

impl FolderFiles {
    /// Contents of a file that `wanted_by` refers to.
    pub(super) fn read(&self, name: &str, wanted_by: &str) -> Result<Vec<u8>, FolderError> {
        let folders: Vec<&str> = self.folders.iter().map(String::as_str).collect();
        find(self.files.as_ref(), &folders, name)
            .map(|(_, bytes)| bytes)
            .map_err(|problem| match problem {
                Unresolved::Missing => FolderError::Missing {
                    file: name.to_owned(),
                    wanted_by: wanted_by.to_owned(),
                },
                Unresolved::Ambiguous(first, second) => FolderError::Ambiguous {
                    file: name.to_owned(),
                    first,
                    second,
                },
            })
    }

    pub(super) fn table(
        &mut self,
        name: &str,
        wanted_by: &str,
    ) -> Result<Arc<CsvTable>, FolderError> {
        if let Some(table) = self.tables.get(name) {
            return Ok(Arc::clone(table));
        }
        let bytes = self.read(name, wanted_by)?;
        let table = Arc::new(CsvTable::parse(name, &bytes)?);
        self.tables.insert(name.to_owned(), Arc::clone(&table));
        Ok(table)
    }
}

/// A complaint about a member of flight.json.
pub(super) fn contents(place: &str, cause: impl Into<String>) -> FolderError {
    FolderError::Contents {
        file: FLIGHT_FILE.to_owned(),
        place: place.to_owned(),
        cause: cause.into(),
    }
}
