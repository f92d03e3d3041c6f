//! The pictures of a flight folder.

use std::sync::Arc;

use pilotage_base::files::{FileSet, Unresolved, find, joined};
use pilotage_flight::{FrameError, FrameSource, SharedFrames};
use pilotage_raster::raster::{Picture, decode_picture};

/// Pictures in files, read and decoded when they are asked for.
#[derive(Clone)]
pub struct FolderFrames {
    files: Arc<dyn FileSet>,
    folders: Vec<String>,
    names: Vec<String>,
}

impl FolderFrames {
    /// Pictures of the given names in `directory`, which is looked up in `folders`.
    pub(crate) fn new(
        files: Arc<dyn FileSet>,
        folders: Vec<String>,
        directory: &str,
        names: Vec<String>,
    ) -> Self {
        let names = names
            .into_iter()
            .map(|name| joined(directory, &name))
            .collect();
        Self {
            files,
            folders,
            names,
        }
    }
}

impl FrameSource for FolderFrames {
    fn picture(&mut self, index: usize) -> Result<Picture, FrameError> {
        let bytes = self.encoded(index)?;
        decode_picture(&bytes).map_err(|e| FrameError::Unreadable {
            name: self.names[index].clone(),
            cause: e.to_string(),
        })
    }

    fn encoded(&mut self, index: usize) -> Result<Vec<u8>, FrameError> {
        let name = self.names.get(index).ok_or(FrameError::OutOfRange(index))?;
        let folders: Vec<&str> = self.folders.iter().map(String::as_str).collect();
        match find(self.files.as_ref(), &folders, name) {
            Ok((_, bytes)) => Ok(bytes),
            Err(problem) => Err(FrameError::Unreadable {
                name: name.clone(),
                cause: match problem {
                    Unresolved::Missing => "the file is missing".to_owned(),
                    Unresolved::Ambiguous(first, second) => {
                        format!("it could be {first} or {second}")
                    }
                },
            }),
        }
    }

    fn another(&self) -> Option<SharedFrames> {
        Some(Box::new(self.clone()))
    }
}
