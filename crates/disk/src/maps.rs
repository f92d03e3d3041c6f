//! Maps of the disk, and the files that they were read from.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pilotage_core::frames::LocalFrame;
use pilotage_core::imagery::{CachedImagery, Imagery};
use pilotage_core::mission::OpenMap;

use crate::files::DirectoryFiles;
use crate::read_files::ReadFiles;

/// Memory for map tiles, megabytes.
pub const MAP_CACHE: usize = 128;

/// The picture with the georeference that lies beside it, in the world frame of a flight or mission;
/// `megabytes` of its tiles are kept.
///
/// ```
/// use pilotage_core::raster::{Raster, encode_png};
/// use pilotage_disk::maps::{MAP_CACHE, open_map};
///
/// let folder = std::env::temp_dir().join(format!("pilotage-map-{}", std::process::id()));
/// std::fs::create_dir_all(&folder)?;
/// std::fs::write(folder.join("town.png"), encode_png(&Raster::filled(40, 20, [90, 90, 90]))?)?;
/// // Pixels of half a metre; the middle of the first is a quarter of a metre from the origin.
/// std::fs::write(folder.join("town.pgw"), "0.5\n0\n0\n-0.5\n0.25\n-0.25\n")?;
/// let map = open_map(&folder.join("town.png"), None, MAP_CACHE)?;
/// assert_eq!((map.map.bounds().east, map.map.bounds().south), (20.0, -10.0));
/// assert_eq!(map.read, ["town.pgw", "town.png"].map(|name| folder.join(name)));
/// std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn open_map(
    path: &Path,
    frame: Option<LocalFrame>,
    megabytes: usize,
) -> Result<MapOnDisk, Box<dyn std::error::Error>> {
    let directory = ReadFiles::of(DirectoryFiles::around(path)?);
    let name = path
        .file_name()
        .map(|n| n.to_string_lossy().into_owned())
        .unwrap_or_default();
    let map = pilotage_core::mission::open_map(&directory, &name, frame)?;
    Ok(MapOnDisk {
        read: directory.paths(),
        ..MapOnDisk::cached(map, megabytes)
    })
}

/// A map that was opened.
pub struct MapOnDisk {
    /// The map.
    pub map: Arc<dyn Imagery>,
    /// The world frame that it was put into, if it lies on the globe.
    pub frame: Option<LocalFrame>,
    /// Sentences on what was assumed of it or left out.
    pub notes: Vec<String>,
    /// Files of the disk that it was read from: its own, and those beside it that say where it lies; none of a map out of an
    /// archive or a generated one.
    pub read: Vec<PathBuf>,
}

impl MapOnDisk {
    /// The map with a memory for its pixels.
    pub fn cached(map: OpenMap, megabytes: usize) -> Self {
        Self {
            frame: map.frame().copied(),
            notes: map.notes(),
            read: Vec::new(),
            map: Arc::new(CachedImagery::new(Arc::new(map), megabytes)),
        }
    }
}
