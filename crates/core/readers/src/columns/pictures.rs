//! Pictures that a table names, with the times of its rows.

use std::collections::BTreeMap;
use std::sync::Arc;

use pilotage_base::files::{FileSet, find, folder_of};
use pilotage_flight::{CameraFile, MountFile};
use pilotage_raster::camera::{Distortion, Lens, UNSTATED_MOUNT_DEVIATION};
use pilotage_raster::raster::decode_picture;

use super::ColumnMap;
use super::bodies::tells_pitch_of_camera;
use crate::folder::{ChannelFile, CsvTable, FramesFile};

/// Endings of pictures.
const ENDINGS: [&str; 3] = [".jpg", ".jpeg", ".png"];
/// Field of view across that is assumed of a camera that nobody describes, degrees.
const ACROSS: f64 = 60.0;

/// The pictures that a column of one of the tables names, each row one, and a camera of their size; `None` if no column
/// does.
pub(super) fn named(
    files: &Arc<dyn FileSet>,
    maps: &[ColumnMap],
    tables: &BTreeMap<String, Arc<CsvTable>>,
    channels: &[ChannelFile],
) -> Option<((FramesFile, CameraFile), String)> {
    maps.iter().find_map(|map| {
        let table = tables.get(&map.file)?;
        let time = channels.iter().find(|c| c.file == map.file)?.time.clone();
        map.columns.iter().find_map(|column| {
            let names = table.texts(&column.name).ok()?;
            let is_picture = |name: &&str| {
                let name = name.to_lowercase();
                ENDINGS.iter().any(|ending| name.ends_with(ending))
            };
            let first = *names.first().filter(|_| names.iter().all(is_picture))?;
            let (path, bytes) = find(files.as_ref(), &[folder_of(&map.file)], first).ok()?;
            let picture = decode_picture(&bytes).ok()?;
            let frames = FramesFile {
                file: map.file.clone(),
                name: column.name.clone(),
                time: time.clone(),
                directory: folder_of(&path).to_owned(),
                stored_turn_deg: BTreeMap::new(),
            };
            let camera = CameraFile {
                width: picture.width(),
                height: picture.height(),
                focal_px: None,
                horizontal_fov_deg: Some(ACROSS),
                principal_px: None,
                lens: Lens::default(),
                distortion: Distortion::default(),
                mount_deg: MountFile::default(),
                mount_deviation_deg: if tells_pitch_of_camera(&map.columns) {
                    0.0
                } else {
                    UNSTATED_MOUNT_DEVIATION.to_degrees()
                },
            };
            let note = format!(
                "{} names {} pictures; the camera is assumed to look straight down and to see {ACROSS:.0}° across",
                column.name,
                names.len()
            );
            Some(((frames, camera), note))
        })
    })
}
