//! Template that is looked for in a picture.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::flatness::FLATNESS;
use super::fourier::Spectrum;
use crate::raster::simd::BlockKernel;
use crate::raster::{Gray, Raster};

/// Spectra of one template kept for searches of different sizes.
const KEPT_SPECTRA: usize = 3;

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
    /// Mask that is one where the template counts; `None` if it counts everywhere.
    pub(super) mask: Option<Kernel>,
    /// Pixels that count.
    pub(super) count: f64,
}

impl Template {
    /// Prepares a patch, or answers `None` if it is empty or flat: such a patch matches nothing.
    ///
    /// ```
    /// use pilotage_raster::raster::{Gray, Template, highest_peak};
    ///
    /// let search = Gray::from_fn(60, 40, |x, y| ((x * x * 31 + x * y * 17 + y * y * 7) % 101) as f32);
    /// let patch = search.crop(23, 11, 16, 12).ok_or("beyond the picture")?;
    /// // Other light does not matter.
    /// let template = Template::new(&patch.map(|v| 0.5 * v + 60.0)).ok_or("flat")?;
    /// let peak = highest_peak(&template.correlate(&search)).ok_or("no peak")?;
    /// assert_eq!(peak.sample, (23, 11));
    /// assert!(Template::new(&Gray::filled(8, 8, 5.0)).is_none());
    /// # Ok::<(), &str>(())
    /// ```
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
