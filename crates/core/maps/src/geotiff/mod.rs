//! `GeoTIFF` as imagery: any size, only the tiles in sight are read.

mod band_metadata;
mod coarse;
mod colour;
#[cfg(test)]
mod colour_tests;
mod keys;
mod mask;
mod place;
#[cfg(test)]
mod place_tests;
#[cfg(test)]
mod tests;
mod tiles;

use std::sync::{Arc, Mutex, PoisonError};

pub(crate) use band_metadata::BandMetadata;
use coarse::Coarse;
use colour::Colours;
pub use keys::GeoKeys;
pub(crate) use place::heights_scale;
pub use place::world_file;
use place::{has_negative_height, is_placed_by_camera};
use tiles::ColouredTiles;

use super::tiff::{TiffError, TiffFile};
use pilotage_base::frames::{Geodetic, GroundRect, LocalFrame, ReferenceSystem};
use pilotage_base::{
    bytes::ByteSource,
    georeference::{Georeference, GeoreferenceError},
};
use pilotage_raster::imagery::resample::{PyramidRegion, WindowPixels, samples_per_side};
use pilotage_raster::imagery::{Imagery, Placement, Window};
use pilotage_raster::raster::{Raster, Rgba};

/// Most pixels that are held at once to draw a window; larger windows are drawn in parts.
const MOST_PIXELS: f64 = 8e6;

/// Limits of the memory that a map may keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MapMemory {
    /// Bytes of unpacked tiles.
    pub tiles: usize,
    /// Bytes of the coarse pyramid of files that bring none.
    pub coarse: usize,
}

impl Default for MapMemory {
    fn default() -> Self {
        Self {
            tiles: 96 << 20,
            coarse: 48 << 20,
        }
    }
}

/// Why a file cannot be a map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GeoTiffError {
    /// The file cannot be read.
    #[error(transparent)]
    Tiff(#[from] TiffError),
    /// Nothing says where the map lies.
    #[error(
        "{file}: the file does not say where it lies; put a world file (.tfw) beside it, or georeference it"
    )]
    NoPlace {
        /// Name of the file.
        file: String,
    },
    /// Its pixels are placed by the camera that took them.
    #[error(
        "{file}: its pixels are placed by the coefficients of a satellite's camera (RPC), which are not read: orthorectify it (`gdalwarp -rpc`), or georeference it"
    )]
    ByCamera {
        /// Name of the file.
        file: String,
    },
    /// Nothing says what the coordinates mean.
    #[error(
        "{file}: the file has coordinates but does not say of which reference system; name one (EPSG:4326, EPSG:3857 or a UTM zone), or put a .prj beside it"
    )]
    NoSystem {
        /// Name of the file.
        file: String,
    },
    /// The coordinates cover no ground.
    #[error("{file}: {cause}")]
    Georeference {
        /// Name of the file.
        file: String,
        /// Error of the georeference.
        cause: GeoreferenceError,
    },
}

/// A `GeoTIFF` before a world frame is chosen for it.
#[derive(Clone)]
pub struct GeoTiffFile {
    /// The pixels.
    pub tiff: TiffFile,
    /// Place of the pixels on the ground.
    pub georeference: Georeference,
    /// Contents of the keys.
    pub keys: GeoKeys,
    /// Notes on what the file says of its place and is taken otherwise, in sentences that name it.
    pub notes: Vec<String>,
}

/// A `GeoTIFF` as a map.
pub struct GeoTiff {
    tiles: ColouredTiles,
    placement: Placement,
    coarse: Option<Mutex<Coarse>>,
    /// Name of the file beside it that hides parts of it, and is not heeded.
    mask: Option<String>,
    /// Notes on the file itself.
    notes: Vec<String>,
}

impl GeoTiffFile {
    /// Reads the directories of a file. What it does not say itself is taken from `beside`, the
    /// world file beside it, and `system`.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use pilotage_maps::{GeoTiffFile, bytes::MemoryBytes};
    /// # // A grey picture of 4 × 2 pixels: header, pixels, numbers, directory.
    /// # let mut bytes = b"II*\0".to_vec();
    /// # bytes.extend(120_u32.to_le_bytes());
    /// # bytes.extend([100; 8]); // pixels at 8
    /// # bytes.extend([0.1, 0.1, 0.0].iter().flat_map(|v: &f64| v.to_le_bytes())); // at 16
    /// # bytes.extend([0.0, 0.0, 0.0, 10.0, 50.0, 0.0].iter().flat_map(|v: &f64| v.to_le_bytes())); // at 40
    /// # let keys = [1, 1, 0, 3, 1024, 0, 1, 2, 1025, 0, 1, 1, 2048, 0, 1, 4326];
    /// # bytes.extend(keys.iter().flat_map(|v: &u16| v.to_le_bytes())); // at 88
    /// # let tags: [(u16, u16, u32, u32); 12] = [
    /// #     (256, 3, 1, 4), (257, 3, 1, 2), (258, 3, 1, 8), (259, 3, 1, 1), (262, 3, 1, 1), (273, 4, 1, 8),
    /// #     (277, 3, 1, 1), (278, 3, 1, 2), (279, 4, 1, 8),
    /// #     (33550, 12, 3, 16), (33922, 12, 6, 40), (34735, 3, 16, 88),
    /// # ];
    /// # bytes.extend((tags.len() as u16).to_le_bytes());
    /// # for (tag, kind, count, value) in tags {
    /// #     bytes.extend([tag, kind].iter().flat_map(|v| v.to_le_bytes()));
    /// #     bytes.extend([count, value].iter().flat_map(|v| v.to_le_bytes()));
    /// # }
    /// # bytes.extend([0; 4]);
    ///
    /// // 4 × 2 pixels of a tenth of a degree, the north-west corner at 50° N, 10° E.
    /// let file = GeoTiffFile::open(Arc::new(MemoryBytes::new("map.tif", bytes)), None, None)?;
    /// assert_eq!(file.size(), (4, 2));
    /// let middle = file.origin().ok_or("no place")?;
    /// assert!((middle.latitude.to_degrees() - 49.9).abs() < 1e-9);
    /// assert!((middle.longitude.to_degrees() - 10.2).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn open(
        source: Arc<dyn ByteSource>,
        beside: Option<Georeference>,
        system: Option<ReferenceSystem>,
    ) -> Result<Self, GeoTiffError> {
        let tiff = TiffFile::open(source)?;
        let file = || tiff.name().to_owned();
        let keys = GeoKeys::read(&tiff.directory, system)?;
        let own = world_file(&tiff.directory, keys.is_point)?;
        let georeference = match (own, beside) {
            (Some(own), _) => {
                let system = system.or(keys.system);
                let system = system.ok_or_else(|| GeoTiffError::NoSystem { file: file() })?;
                Georeference::Projected { system, file: own }
            }
            (None, Some(beside)) => match system.or(keys.system) {
                Some(system) => beside.with_system(system),
                None => beside,
            },
            (None, None) if is_placed_by_camera(&tiff.directory) => {
                return Err(GeoTiffError::ByCamera { file: file() });
            }
            (None, None) => return Err(GeoTiffError::NoPlace { file: file() }),
        };
        let is_upside_down = own.is_some() && has_negative_height(&tiff.directory);
        let note = || {
            format!(
                "{}: the height of its pixels is negative; it is taken to have north up, as other programs do.",
                file()
            )
        };
        Ok(Self {
            notes: is_upside_down.then(note).into_iter().collect(),
            tiff,
            georeference,
            keys,
        })
    }

    /// Reads the directories of a file whose place is known better than by the file.
    pub fn put(
        source: Arc<dyn ByteSource>,
        georeference: Georeference,
    ) -> Result<Self, GeoTiffError> {
        Ok(Self {
            tiff: TiffFile::open(source)?,
            georeference,
            keys: GeoKeys::default(),
            notes: Vec::new(),
        })
    }

    /// Width and height, pixels.
    pub fn size(&self) -> (usize, usize) {
        let picture = &self.tiff.levels()[0];
        (picture.width, picture.height)
    }

    /// A place for the origin of a world frame: the middle of the map.
    pub fn origin(&self) -> Option<Geodetic> {
        let (width, height) = self.size();
        self.georeference.origin(width, height)
    }

    /// Placement of the pixels in the world frame `frame`.
    pub fn placement(&self, frame: &LocalFrame) -> Result<Placement, GeoTiffError> {
        let (width, height) = self.size();
        Placement::on_globe(self.georeference, *frame, width, height).map_err(|cause| {
            GeoTiffError::Georeference {
                file: self.tiff.name().to_owned(),
                cause,
            }
        })
    }
}

impl GeoTiff {
    /// The file as a map in the world frame `frame`; an error if it is no picture.
    pub fn new(
        file: GeoTiffFile,
        frame: &LocalFrame,
        memory: MapMemory,
    ) -> Result<Self, GeoTiffError> {
        let placement = file.placement(frame)?;
        let colours = Colours::of(&file.tiff)?;
        let tiles = ColouredTiles::new(file.tiff, colours, memory.tiles);
        let coarse = Coarse::new(&tiles, memory.coarse).map(Mutex::new);
        Ok(Self {
            tiles,
            placement,
            coarse,
            mask: None,
            notes: file.notes,
        })
    }

    /// The same with the name of the file beside it that hides parts of it, if there is one.
    #[must_use]
    pub fn with_mask(self, mask: Option<String>) -> Self {
        Self { mask, ..self }
    }

    /// Notes on what the file says of its place, and that parts are shown which a mask beside it hides, in sentences.
    pub fn notes(&self) -> Vec<String> {
        let mask = self.mask.as_ref().map(|mask| {
            format!(
                "{mask}: this mask hides parts of the map and is not read, so that they are shown; `gdalwarp -dstalpha` \
                 writes the map with it"
            )
        });
        self.notes.iter().cloned().chain(mask).collect()
    }

    /// Placement of the pixels.
    pub fn placement(&self) -> &Placement {
        &self.placement
    }

    /// Sample of a 16-bit picture that is shown as full brightness, 255 for 8 bits.
    pub fn white(&self) -> u32 {
        self.tiles.colours.white()
    }

    /// Level of the file for a window whose pixels are `ratio` pixels of the picture wide, and the
    /// pixels of the picture per pixel of that level.
    fn level(&self, ratio: f64) -> (usize, f64) {
        let levels = self.tiles.file.levels();
        let factor = |level: usize| levels[0].width as f64 / levels[level].width as f64;
        let fits = |level: &usize| factor(*level) <= ratio * 1.01;
        let level = (0..levels.len()).rev().find(fits).unwrap_or(0);
        (level, factor(level))
    }

    /// The window from the coarse pyramid, if that is fine enough.
    fn coarse_window(
        &self,
        sight: &WindowPixels,
        ratio: f64,
        make_missing: bool,
    ) -> Option<(Raster<Rgba>, bool)> {
        let mut coarse = self
            .coarse
            .as_ref()?
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        let levels = self.tiles.file.levels();
        let source = &levels[coarse.level];
        let scale = (
            source.width as f64 / levels[0].width as f64,
            source.height as f64 / levels[0].height as f64,
        );
        let fine = coarse.factor as f64 / scale.0;
        if fine > ratio * 1.01 {
            return None;
        }
        let (low, high) = sight.extent()?;
        let first = ((low.x * scale.0) as usize, (low.y * scale.1) as usize);
        let end = (
            ((high.x * scale.0).ceil() as usize).min(source.width),
            ((high.y * scale.1).ceil() as usize).min(source.height),
        );
        let missing = coarse.missing(first, end);
        let is_whole = make_missing || missing.is_empty();
        if make_missing {
            for block in missing {
                coarse.make(&self.tiles, block);
            }
        }
        let finest = coarse.factor;
        let copies = coarse.copies();
        let copy = ((ratio * 1.01 / fine).log2() as usize).min(copies.len() - 1);
        let factor = (finest << copy) as f64;
        let pixels = &copies[copy];
        let part = PyramidRegion {
            pixels,
            first: (0, 0),
            level: (pixels.width(), pixels.height()),
            scale: (scale.0 / factor, scale.1 / factor),
        };
        let per_side = samples_per_side(ratio * scale.0 / factor);
        Some((sight.draw(&part, per_side), is_whole))
    }

    /// Two halves of a window, put together.
    fn in_halves(&self, window: &Window) -> Raster<Rgba> {
        let (width, height) = (window.width, window.height);
        let mut out = Raster::filled(width, height, [0; 4]);
        let is_wide = width >= height;
        let first = Window {
            width: if is_wide { width / 2 } else { width },
            height: if is_wide { height } else { height / 2 },
            ..*window
        };
        let (right, down) = if is_wide {
            (first.width, 0)
        } else {
            (0, first.height)
        };
        let second = Window {
            west_edge: window.west_edge + right as f64 * window.gsd,
            north_edge: window.north_edge - down as f64 * window.gsd,
            width: width - right,
            height: height - down,
            ..*window
        };
        for (half, right, down) in [(first, 0, 0), (second, right, down)] {
            let drawn = self.window(&half);
            for row in 0..half.height {
                out.row_mut(down + row)[right..][..half.width].copy_from_slice(drawn.row(row));
            }
        }
        out
    }
}

impl Imagery for GeoTiff {
    fn name(&self) -> &str {
        self.tiles.file.name()
    }

    fn bounds(&self) -> GroundRect {
        self.placement.bounds()
    }

    fn native_gsd(&self) -> f64 {
        self.placement.gsd()
    }

    /// From the overview just finer than asked, or from the coarse pyramid, of which what is in
    /// sight is made first.
    fn window(&self, window: &Window) -> Raster<Rgba> {
        let empty = || Raster::filled(window.width, window.height, [0; 4]);
        let ratio = window.gsd / self.native_gsd();
        let sight = WindowPixels::new(window, &self.placement);
        let Some((low, high)) = sight.extent() else {
            return empty();
        };
        if let Some((drawn, _)) = self.coarse_window(&sight, ratio, true) {
            return drawn;
        }
        let (level, factor) = self.level(ratio);
        let levels = self.tiles.file.levels();
        let layout = &levels[level];
        let scale = (
            layout.width as f64 / levels[0].width as f64,
            layout.height as f64 / levels[0].height as f64,
        );
        let pixels = (high.x - low.x) * scale.0 * (high.y - low.y) * scale.1;
        if pixels > MOST_PIXELS && window.width * window.height > 1 {
            return self.in_halves(window);
        }
        // A pixel of the level to each side for the bilinear samples at the edge.
        let first = (
            ((low.x * scale.0) as usize).saturating_sub(1),
            ((low.y * scale.1) as usize).saturating_sub(1),
        );
        let end = (
            ((high.x * scale.0) as usize + 2).min(layout.width),
            ((high.y * scale.1) as usize + 2).min(layout.height),
        );
        let rectangle = self.tiles.rectangle(level, first, end);
        let part = PyramidRegion {
            pixels: &rectangle,
            first,
            level: (layout.width, layout.height),
            scale,
        };
        sight.draw(&part, samples_per_side(ratio / factor))
    }

    /// The window without waiting for the coarse pyramid: what is missing of it is transparent.
    /// Also says whether the window is whole; if not, [`prepare`](Self::prepare) and ask again. Bytes that could not
    /// be had are asked for again, too.
    fn window_so_far(&self, window: &Window) -> (Raster<Rgba>, bool) {
        let ratio = window.gsd / self.native_gsd();
        let sight = WindowPixels::new(window, &self.placement);
        self.coarse_window(&sight, ratio, false).unwrap_or_else(|| {
            let before = self.tiles.unreached();
            let drawn = self.window(window);
            (drawn, self.tiles.unreached() == before)
        })
    }

    /// Makes blocks of the coarse pyramid. A file with overviews has none to make.
    fn prepare(&self, pieces: usize) -> (usize, usize) {
        let Some(coarse) = &self.coarse else {
            return (0, 0);
        };
        let mut coarse = coarse.lock().unwrap_or_else(PoisonError::into_inner);
        for _ in 0..pieces {
            let Some(block) = coarse.pending() else { break };
            coarse.make(&self.tiles, block);
        }
        coarse.progress()
    }

    fn problems(&self) -> Vec<String> {
        let problems = self.tiles.problems();
        problems.iter().map(ToString::to_string).collect()
    }
}
