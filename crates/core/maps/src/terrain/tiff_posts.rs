//! Posts of an elevation model in a `GeoTIFF`.

use std::sync::{Mutex, PoisonError};

use super::TerrainError;
use super::highest::may_be_height;
use super::units::metres_per_unit;
use crate::GeoTiffFile;
use crate::geotiff::{BandMetadata, heights_scale};
use crate::tiff::{Chunk, Photometric, SampleKind, TiffError, TiffFile};
use pilotage_raster::imagery::kept::RecentValues;

/// Bytes of unpacked tiles that are kept.
const MEMORY: usize = 32 << 20;
/// Fewest bits that an unpacked sample takes, of reals: those of 16 bits become 32.
const REAL_BITS: usize = 32;

/// Column and row of a tile.
type PostTile = (usize, usize);

/// Heights of the first band of a file: height = scale · sample + offset.
pub(super) struct TiffPosts {
    file: TiffFile,
    /// Metres per unit of the samples.
    scale: f64,
    /// Height of the sample 0, metres.
    offset: f64,
    /// Sample of posts without a height.
    no_data: Option<f64>,
    kept: RecentValues<PostTile, Option<Chunk>>,
    masks: RecentValues<PostTile, Option<Chunk>>,
    problem: Mutex<Option<TiffError>>,
    /// Notes on the place of the file.
    notes: Vec<String>,
}

impl TiffPosts {
    /// The first band of `file` as heights; an error if its pixels are colours or its values are in
    /// no unit of height.
    pub fn new(file: &GeoTiffFile) -> Result<Self, TerrainError> {
        let tiff = &file.tiff;
        let layout = &tiff.levels()[0];
        let (name, samples) = (|| tiff.name().to_owned(), layout.samples);
        if is_coloured(layout.photometric) {
            let file = name();
            return Err(TerrainError::Picture { file, samples });
        }
        let band = BandMetadata::of(&tiff.directory, 0).map_err(crate::GeoTiffError::from)?;
        let metres = metres_per_unit(&file.keys, band.unit.as_deref());
        let metres = metres.map_err(|cause| TerrainError::Unit {
            file: name(),
            cause,
        })?;
        let own = (band.scale, band.offset);
        let of_place = heights_scale(&tiff.directory).filter(|_| file.keys.has_scaled_heights);
        let (scale, offset) = of_place.unwrap_or(own);
        Ok(Self {
            scale: scale * metres,
            offset: offset * metres,
            // Written with more digits than the samples have.
            no_data: layout.no_data.map(|value| match layout.kind {
                SampleKind::F16 | SampleKind::F32 => f64::from(value as f32),
                _ => value,
            }),
            kept: RecentValues::new(MEMORY),
            masks: RecentValues::new(MEMORY / 8),
            problem: Mutex::new(None),
            notes: file.notes.clone(),
            file: file.tiff.clone(),
        })
    }

    /// Name of the file.
    pub fn name(&self) -> &str {
        self.file.name()
    }

    /// Notes on choices where the file leaves a choice, in sentences.
    pub fn notes(&self) -> Vec<String> {
        let layout = &self.file.levels()[0];
        let bands = layout.samples - usize::from(layout.alpha.is_some());
        let name = self.name();
        let first = || format!("{name}: the first of {bands} bands is taken for heights.");
        let first = (bands > 1).then(first);
        self.notes.iter().cloned().chain(first).collect()
    }

    /// The first part of the file that could not be read, if any; its heights are unknown.
    pub fn problem(&self) -> Option<TiffError> {
        let problem = self.problem.lock().unwrap_or_else(PoisonError::into_inner);
        problem.clone()
    }

    /// Height at a post, metres; panics outside.
    pub fn post(&self, column: usize, row: usize) -> Option<f64> {
        let layout = &self.file.levels()[0];
        let bits = layout.kind.bits().max(REAL_BITS);
        let tile = (column / layout.chunk_width, row / layout.chunk_height);
        let inside = (column % layout.chunk_width, row % layout.chunk_height);
        let chunk = self.kept.get_or_make(tile, || {
            let chunk = self.file.chunk(0, tile.0, tile.1)?;
            let bytes = chunk.as_ref().map_or(0, |c| c.samples.len() * bits / 8);
            Ok((chunk, bytes))
        });
        let chunk = self.or_remember(chunk)?;
        let chunk = chunk.as_ref().as_ref()?;
        let index = (inside.1 * chunk.width + inside.0) * chunk.samples_per_pixel;
        let is_covered = |(alpha, _)| chunk.samples.real(index + alpha) != 0.0;
        if !layout.alpha.is_none_or(is_covered) || !self.is_in_mask(column, row)? {
            return None;
        }
        let sample = chunk.samples.real(index);
        let height = self.scale * sample + self.offset;
        (self.no_data != Some(sample) && may_be_height(height)).then_some(height)
    }

    /// Whether the mask of the file, if there is one, says that a post is valid; `None` if it cannot
    /// be read.
    fn is_in_mask(&self, column: usize, row: usize) -> Option<bool> {
        let Some(layout) = self.file.mask(0) else {
            return Some(true);
        };
        let tile = (column / layout.chunk_width, row / layout.chunk_height);
        let inside = (column % layout.chunk_width, row % layout.chunk_height);
        let chunk = self.masks.get_or_make(tile, || {
            let chunk = self.file.mask_chunk(0, tile.0, tile.1)?;
            let bytes = chunk.as_ref().map_or(0, |c| c.samples.len());
            Ok((chunk, bytes))
        });
        let chunk = self.or_remember(chunk)?;
        let is_set = |chunk: &Chunk| {
            let index = (inside.1 * chunk.width + inside.0) * chunk.samples_per_pixel;
            chunk.samples.real(index) != 0.0
        };
        // A tile of a mask that is left out is not valid.
        Some(chunk.as_ref().as_ref().is_some_and(is_set))
    }

    fn or_remember<T>(&self, made: Result<T, TiffError>) -> Option<T> {
        made.map_err(|problem| {
            let mut first = self.problem.lock().unwrap_or_else(PoisonError::into_inner);
            first.get_or_insert(problem);
        })
        .ok()
    }
}

/// Whether samples are colours, not grey or heights.
fn is_coloured(photometric: Photometric) -> bool {
    use Photometric::{BlackIsZero, Mask, Palette, Rgb, WhiteIsZero, YCbCr};
    match photometric {
        Rgb | Palette | YCbCr | Mask => true,
        BlackIsZero | WhiteIsZero => false,
    }
}

/// Whether a TIFF is an elevation model by itself, without being asked for as one: without colours and
/// with samples that no picture has. Whole numbers of up to 16 bits without a sign are grey pictures.
pub fn holds_heights(file: &TiffFile) -> bool {
    let layout = &file.levels()[0];
    let is_grey = matches!(
        layout.kind,
        SampleKind::Bits(_) | SampleKind::U8 | SampleKind::U16
    );
    !is_coloured(layout.photometric) && !is_grey
}
