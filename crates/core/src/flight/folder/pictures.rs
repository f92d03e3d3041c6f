//! The pictures of a flight folder.

use std::io::Cursor;
use std::sync::Arc;

use crate::flight::files::{FileSet, Unresolved, find, joined};
use crate::flight::{FrameError, FrameSource};
use crate::raster::{Picture, Raster};

/// Pictures in files, read and decoded when they are asked for.
#[derive(Clone)]
pub struct FolderFrames {
    files: Arc<dyn FileSet>,
    folders: Vec<String>,
    names: Vec<String>,
}

impl FolderFrames {
    /// Pictures of the given names in `directory`, which is looked up in `folders`.
    pub(super) fn new(
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

/// Decodes a JPEG or PNG; the error says in words what is wrong.
pub fn decode_picture(bytes: &[u8]) -> Result<Picture, String> {
    let decoded = image::ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|e| e.to_string())?
        .decode()
        .map_err(|e| e.to_string())?
        .into_rgb8();
    let (width, height) = (decoded.width() as usize, decoded.height() as usize);
    let pixels = decoded
        .into_raw()
        .chunks_exact(3)
        .map(|p| [p[0], p[1], p[2]])
        .collect();
    Raster::from_pixels(width, height, pixels).ok_or_else(|| "the picture is cut off".to_owned())
}

impl FrameSource for FolderFrames {
    fn picture(&mut self, index: usize) -> Result<Picture, FrameError> {
        let bytes = self.encoded(index)?;
        decode_picture(&bytes).map_err(|cause| FrameError::Unreadable {
            name: self.names[index].clone(),
            cause,
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
}
