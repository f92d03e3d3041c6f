//! The features of one window, for those who train.

use super::grid::RowGrid;
use super::layout::FeatureLayout;
use super::model::{CascadeFeature, CascadeKind, kind};
use pilotage_raster::raster::Raster;

/// A window with one pixel more on every side: gradients at its rim look there.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    pixels: Raster<u8>,
}

impl Patch {
    /// The window of `width` × `height` pixels whose upper left pixel is (`column`, `row`) of `picture`,
    /// or `None` if it does not lie inside. Beyond the picture its outermost pixels go on, as they do
    /// for the scan.
    pub fn cut(
        picture: &Raster<u8>,
        column: usize,
        row: usize,
        width: usize,
        height: usize,
    ) -> Option<Self> {
        let inside = column + width <= picture.width() && row + height <= picture.height();
        let source = |from: usize, i: usize, limit: usize| (from + i).clamp(1, limit) - 1;
        (inside && width > 0 && height > 0).then(|| Self {
            pixels: Raster::from_fn(width + 2, height + 2, |x, y| {
                let x = source(column, x, picture.width());
                picture.get(x, source(row, y, picture.height()))
            }),
        })
    }

    /// A window given with the pixel more on every side, or `None` if there is nothing inside.
    pub fn with_margin(pixels: Raster<u8>) -> Option<Self> {
        (pixels.width() > 2 && pixels.height() > 2).then_some(Self { pixels })
    }

    /// Width of the window, pixels.
    pub fn width(&self) -> usize {
        self.pixels.width() - 2
    }

    /// Height of the window, pixels.
    pub fn height(&self) -> usize {
        self.pixels.height() - 2
    }

    /// The pixels with those around.
    pub fn pixels(&self) -> &Raster<u8> {
        &self.pixels
    }
}

/// Features laid out for patches of one size; all of them are of one kind and lie in the window.
///
/// What it says of a patch is to the bit what the scan sees where the patch was cut.
#[derive(Clone, Debug)]
pub struct PatchEvaluator {
    layout: FeatureLayout,
    width: usize,
    height: usize,
}

impl PatchEvaluator {
    /// For windows of `width` × `height` pixels.
    ///
    /// # Panics
    /// Evaluation panics if a feature does not lie in such a window.
    pub fn new(features: &[CascadeFeature], width: usize, height: usize) -> Self {
        Self {
            layout: FeatureLayout::new(features, width, height, RowGrid::new(width + 2, 1)),
            width,
            height,
        }
    }

    /// Values of all features, Haar ones divided by the deviation of the window; answers false, and
    /// zeros, for a window so flat that the scan refuses it unseen.
    ///
    /// # Panics
    /// If `patch` is of another size or `out` not as long as the features.
    pub fn values(&self, patch: &Patch, out: &mut [f32]) -> bool {
        self.check(patch, out.len());
        let tables = self.layout.tables(&patch.pixels);
        let at = self.layout.grid.place(1, 1);
        let factor = self.layout.factor(&tables, at);
        for (i, out) in out.iter_mut().enumerate() {
            *out = factor.map_or(0.0, |f| self.layout.value(&tables, i, at, f));
        }
        factor.is_some()
    }

    /// Codes of all LBP features.
    ///
    /// # Panics
    /// If `patch` is of another size or `out` not as long as the features.
    pub fn codes(&self, patch: &Patch, out: &mut [u8]) {
        self.check(patch, out.len());
        let tables = self.layout.tables(&patch.pixels);
        let at = self.layout.grid.place(1, 1);
        for (i, out) in out.iter_mut().enumerate() {
            *out = self.layout.code(&tables, i, at) as u8;
        }
    }

    fn check(&self, patch: &Patch, length: usize) {
        assert_eq!((patch.width(), patch.height()), (self.width, self.height));
        assert_eq!(length, self.layout.len(), "one place for each feature");
    }
}

/// [`PatchEvaluator::values`] for once: values of Haar or HOG features in `patch`.
///
/// # Panics
/// If `out` is not as long as `features`, or one of these leaves the patch.
pub fn feature_values(features: &[CascadeFeature], patch: &Patch, out: &mut [f32]) -> bool {
    debug_assert_ne!(kind(features), CascadeKind::Lbp, "these have codes");
    PatchEvaluator::new(features, patch.width(), patch.height()).values(patch, out)
}

/// [`PatchEvaluator::codes`] for once: codes of LBP features in `patch`, 0 to 255.
///
/// # Panics
/// If `out` is not as long as `features`, or one of these leaves the patch.
pub fn feature_codes(features: &[CascadeFeature], patch: &Patch, out: &mut [u8]) {
    PatchEvaluator::new(features, patch.width(), patch.height()).codes(patch, out);
}
