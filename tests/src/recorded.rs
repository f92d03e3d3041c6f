//! Recorded flights, read by the column maps under `tests/flights`.

use std::path::PathBuf;
use std::sync::Arc;

use pilotage_core::flight::files::FileSet;
use pilotage_core::flight::{FlightFolder, FolderError, read_flight};

use crate::data::{repository, shared};

/// A folder of the disk whose files are asked for by name.
struct Folder(PathBuf);

impl FileSet for Folder {
    fn names(&self) -> Vec<String> {
        vec!["flight.json".to_owned()]
    }

    fn read(&self, name: &str) -> Option<Vec<u8>> {
        std::fs::read(self.0.join(name)).ok()
    }
}

/// The flight `tests/flights/name`, or `None` where the shared data it refers to are absent.
pub fn flight(name: &str, data: &str) -> Option<Result<FlightFolder, FolderError>> {
    shared(data)?;
    let folder = repository().join("tests/flights").join(name);
    Some(read_flight(Arc::new(Folder(folder))))
}
