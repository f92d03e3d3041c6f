//! Folders that know which of their files were read.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use pilotage_core::flight::files::FileSet;
use pilotage_core::imagery::ByteSource;

use crate::files::DirectoryFiles;

/// Files of a folder, and the names of those that were read.
pub(crate) struct ReadFiles {
    files: DirectoryFiles,
    read: Mutex<BTreeSet<String>>,
}

impl ReadFiles {
    /// None was read yet.
    pub(crate) fn of(files: DirectoryFiles) -> Self {
        Self {
            files,
            read: Mutex::default(),
        }
    }

    /// Paths of the files that were read so far, in the order of their names.
    pub(crate) fn paths(&self) -> Vec<PathBuf> {
        let read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        read.iter().map(|name| self.files.path(name)).collect()
    }

    fn noted<T>(&self, name: &str, found: Option<T>) -> Option<T> {
        if found.is_some() {
            let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
            read.insert(name.to_owned());
        }
        found
    }
}

impl FileSet for ReadFiles {
    fn names(&self) -> Vec<String> {
        self.files.names()
    }

    fn read(&self, name: &str) -> Option<Vec<u8>> {
        self.noted(name, self.files.read(name))
    }

    fn left_out(&self) -> Vec<String> {
        self.files.left_out()
    }

    fn source(&self, name: &str) -> Option<Arc<dyn ByteSource>> {
        self.noted(name, self.files.source(name))
    }
}
