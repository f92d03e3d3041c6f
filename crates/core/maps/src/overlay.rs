//! Pictures that KML lays on the ground, as a map.

use pilotage_base::files::{FileSet, ZipFiles};
use pilotage_base::frames::ReferenceSystem;
use pilotage_mission::exchange::ground_overlays;

use crate::map_error::MapFileError;
use crate::map_options::MapOptions;
use crate::mosaic::{CorneredPicture, Mosaic};

/// Endings of files with such pictures.
const ENDINGS: [&str; 2] = [".kmz", ".kml"];

/// Whether a file may hold pictures on the ground, by its name.
pub(crate) fn is_overlay(name: &str) -> bool {
    let lower = name.to_ascii_lowercase();
    ENDINGS.iter().any(|ending| lower.ends_with(ending))
}

/// The map of the pictures that the KML or KMZ `name` among `files` lays on the ground, and what was left
/// out, in sentences.
pub(crate) fn open_overlay(
    files: &dyn FileSet,
    name: &str,
    options: &MapOptions,
) -> Result<(Mosaic, Vec<String>), MapFileError> {
    let missing = || MapFileError::Missing {
        file: name.to_owned(),
    };
    let wrong = |cause: String| MapFileError::Overlay {
        file: name.to_owned(),
        cause,
    };
    let zip;
    let (files, document) = if name.to_ascii_lowercase().ends_with(".kmz") {
        zip = ZipFiles::open(&files.read(name).ok_or_else(missing)?).map_err(wrong)?;
        (&zip as &dyn FileSet, None)
    } else {
        (files, Some(name))
    };
    let found = ground_overlays(files, document).map_err(|cause| wrong(cause.to_string()))?;
    if found.overlays.is_empty() {
        return Err(match found.notes.first() {
            Some(note) => wrong(note.clone()),
            None => MapFileError::NoOverlay {
                file: name.to_owned(),
            },
        });
    }
    let rows: Vec<CorneredPicture> = (found.overlays.into_iter())
        .map(|overlay| CorneredPicture {
            file: overlay.picture,
            line: 0,
            system: ReferenceSystem::Geographic,
            corners: overlay.corners,
        })
        .collect();
    let map = Mosaic::of(files, name, "", &rows, options)?;
    Ok((map, found.notes))
}

#[cfg(test)]
#[path = "overlay_tests.rs"]
mod tests;
