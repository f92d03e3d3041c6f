//! What is looked for.

use std::ops::Range;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::cost;
use super::fourier::Spectrum;
use super::search::{SearchSpectrum, flat_level};
use crate::raster::simd::BlockKernel;
use crate::raster::{Gray, Raster};

/// Spectra of one template kept for searches of different sizes.
const KEPT_SPECTRA: usize = 3;

/// A standard deviation below this part of the largest value counts as flat.
pub(super) const FLATNESS: f64 = 1e-5;

/// A picture patch prepared for correlation: free of its mean, with its norm.
///
/// Prepare it once and correlate it with many pictures: its Fourier transform is kept for the last
/// search sizes. Clones share it.
#[derive(Clone, Debug)]
pub struct Template {
    pub(super) width: usize,
    pub(super) height: usize,
    /// The weight-free pixels minus their mean, zero where masked out.
    pub(super) zero_mean: Kernel,
    /// Root of the sum of squares of `zero_mean`.
    pub(super) norm: f64,
    /// One where the template counts; `None` if it counts everywhere.
    pub(super) mask: Option<Kernel>,
    /// Pixels that count.
    pub(super) count: f64,
}

impl Template {
    /// Prepares a patch, or answers `None` if it is empty or flat: such a patch matches nothing.
    pub fn new(patch: &Gray) -> Option<Self> {
        Self::prepare(patch, None)
    }

    /// Prepares a patch of which only the pixels where `mask` is true count; `None` if they are
    /// flat, fewer than two, or if the sizes differ.
    ///
    /// Costs about three times as much to correlate as a full rectangle.
    pub fn masked(patch: &Gray, mask: &Raster<bool>) -> Option<Self> {
        let same_size = patch.width() == mask.width() && patch.height() == mask.height();
        if mask.pixels().iter().all(|&counts| counts) {
            return same_size.then(|| Self::new(patch)).flatten();
        }
        same_size
            .then(|| Self::prepare(patch, Some(mask.pixels())))
            .flatten()
    }

    fn prepare(patch: &Gray, mask: Option<&[bool]>) -> Option<Self> {
        let pixels = patch.pixels();
        let counts = |index: usize| mask.is_none_or(|mask| mask[index]);
        let count = mask.map_or(pixels.len(), |mask| mask.iter().filter(|&&m| m).count()) as f64;
        if count < 2.0 {
            return None;
        }
        let mut sum = 0.0;
        let mut largest = 0.0f32;
        for (index, &value) in pixels.iter().enumerate() {
            if counts(index) {
                sum += f64::from(value);
                largest = largest.max(value.abs());
            }
        }
        let mean = sum / count;
        let mut energy = 0.0;
        for (index, &value) in pixels.iter().enumerate() {
            if counts(index) {
                energy += (f64::from(value) - mean).powi(2);
            }
        }
        // Also refuses what is not a number.
        if !(energy > count * (FLATNESS * f64::from(largest)).powi(2) && energy.is_finite()) {
            return None;
        }
        let (width, height) = (patch.width(), patch.height());
        let zero_mean: Vec<f32> = patch
            .pixels()
            .iter()
            .enumerate()
            .map(|(index, &v)| {
                if counts(index) {
                    (f64::from(v) - mean) as f32
                } else {
                    0.0
                }
            })
            .collect();
        let mask = mask.map(|mask| mask.iter().map(|&m| f32::from(u8::from(m))).collect());
        Some(Self {
            width,
            height,
            zero_mean: Kernel::new(zero_mean, width, height),
            norm: energy.sqrt(),
            mask: mask.map(|mask| Kernel::new(mask, width, height)),
            count,
        })
    }

    /// Pixels in a row of the template.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows of the template.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Standard deviation of the template's pixels, in the patch's own unit.
    pub fn contrast(&self) -> f64 {
        self.norm / self.count.sqrt()
    }

    /// The correlation surface over all places at which the template lies inside `search`:
    /// value (c, r) belongs to the template with its top-left corner at the corner (c, r).
    ///
    /// Its size is `search.width() - width + 1` by `search.height() - height + 1`; empty if the
    /// template does not fit. Values lie in [-1, 1], 0 over flat windows.
    pub fn correlate(&self, search: &Gray) -> Gray {
        let tile = cost::tile(search.width(), search.height(), self.width, self.height);
        if tile == (search.width(), search.height()) {
            return SearchSpectrum::new(search).correlate(self);
        }
        // Large pictures go in overlapping tiles that fit the cache. All have one size, so that
        // the template is transformed once; the last ones overlap more.
        let columns = search.width() - self.width + 1;
        let rows = search.height() - self.height + 1;
        let (step_x, step_y) = (tile.0 - self.width + 1, tile.1 - self.height + 1);
        let flat = flat_level(search.pixels());
        let mut surface = Gray::filled(columns, rows, 0.0);
        for top in (0..rows).step_by(step_y) {
            let top = top.min(search.height() - tile.1);
            for left in (0..columns).step_by(step_x) {
                let left = left.min(search.width() - tile.0);
                let Some(part) = search.crop(left, top, tile.0, tile.1) else {
                    continue;
                };
                let part = SearchSpectrum::with_flat_level(&part, flat).correlate(self);
                for row in 0..part.height() {
                    surface.row_mut(top + row)[left..left + part.width()]
                        .copy_from_slice(part.row(row));
                }
            }
        }
        surface
    }

    /// The part of the surface of [`Self::correlate`] for the given offsets, cut where it ends;
    /// for a dense look around a place found on a coarser level.
    pub fn correlate_at(&self, search: &Gray, columns: Range<usize>, rows: Range<usize>) -> Gray {
        let end =
            |wanted: usize, whole: usize, own: usize| wanted.min((whole + 1).saturating_sub(own));
        let last_column = end(columns.end, search.width(), self.width);
        let last_row = end(rows.end, search.height(), self.height);
        if columns.start >= last_column || rows.start >= last_row {
            return Gray::filled(0, 0, 0.0);
        }
        search
            .crop(
                columns.start,
                rows.start,
                last_column - columns.start + self.width - 1,
                last_row - rows.start + self.height - 1,
            )
            .map_or_else(
                || Gray::filled(0, 0, 0.0),
                |part| {
                    SearchSpectrum::with_flat_level(&part, flat_level(search.pixels()))
                        .correlate(self)
                },
            )
    }
}

/// A correlation kernel in the forms that the two engines want.
#[derive(Clone, Debug)]
pub(super) struct Kernel {
    pub width: usize,
    pub height: usize,
    pub pixels: Arc<Vec<f32>>,
    blocks: Arc<OnceLock<BlockKernel>>,
    spectra: Arc<Mutex<Vec<Arc<Spectrum>>>>,
}

impl Kernel {
    fn new(pixels: Vec<f32>, width: usize, height: usize) -> Self {
        Self {
            width,
            height,
            pixels: Arc::new(pixels),
            blocks: Arc::default(),
            spectra: Arc::default(),
        }
    }

    /// Cut for the direct engine.
    pub fn blocks(&self) -> &BlockKernel {
        self.blocks
            .get_or_init(|| BlockKernel::new(&self.pixels, self.width, self.height))
    }

    /// Its transform for searches with `stride` pixels in a row, `length` in all.
    pub fn spectrum(&self, stride: usize, length: usize) -> Arc<Spectrum> {
        let find = |kept: &[Arc<Spectrum>]| {
            let mut fitting = kept
                .iter()
                .filter(|s| s.stride == stride && s.length == length);
            fitting.next().cloned()
        };
        let lock = || self.spectra.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = find(&lock()) {
            return found;
        }
        let made = Arc::new(Spectrum::of_kernel(
            &self.pixels,
            self.width,
            stride,
            length,
        ));
        let mut kept = lock();
        if kept.len() >= KEPT_SPECTRA {
            kept.remove(0);
        }
        kept.push(Arc::clone(&made));
        made
    }

    /// Whether [`Self::spectrum`] costs nothing.
    pub fn has_spectrum(&self, stride: usize, length: usize) -> bool {
        let kept = self.spectra.lock().unwrap_or_else(PoisonError::into_inner);
        kept.iter()
            .any(|s| s.stride == stride && s.length == length)
    }
}
