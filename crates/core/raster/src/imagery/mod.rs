//! Whatever can be a map: one trait, one file per source.
//!
//! Nothing above this folder knows where the pixels come from.

mod blank;
mod cache;
mod georeferenced;
mod inset;
pub mod kept;
mod placement;
pub mod resample;

pub use blank::Blank;
pub use cache::{CachedImagery, TILE_SIDE};
pub use georeferenced::{GeoreferencedPicture, decode_map, opaque, without_border};
pub use inset::InsetImagery;
pub use placement::Placement;

use serde::{Deserialize, Serialize};

use crate::raster::{Raster, Rgba};
use pilotage_base::frames::{GroundPoint, GroundRect};

/// A north-up window of the ground at one ground sample distance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Window {
    /// Metres north of the origin of the window's top edge.
    pub north_edge: f64,
    /// Metres east of the origin of the window's left edge.
    pub west_edge: f64,
    /// Ground sample distance, metres per pixel.
    pub gsd: f64,
    /// Pixels from west to east.
    pub width: usize,
    /// Pixels from north to south.
    pub height: usize,
}

impl Window {
    /// The window that covers `rect` at `gsd` metres per pixel (its size is rounded up).
    ///
    /// ```
    /// use pilotage_base::frames::{GroundPoint, GroundRect};
    /// use pilotage_raster::imagery::Window;
    ///
    /// let rect = GroundRect::centered(GroundPoint::new(0.0, 0.0), 60.0, 100.0);
    /// let window = Window::covering(&rect, 0.5);
    /// assert_eq!((window.width, window.height), (200, 120));
    /// assert_eq!(window.pixel_at(&GroundPoint::new(30.0, -50.0)), (0.0, 0.0));
    /// assert_eq!(window.ground_at(100.0, 60.0), GroundPoint::new(0.0, 0.0));
    /// ```
    pub fn covering(rect: &GroundRect, gsd: f64) -> Self {
        Self {
            north_edge: rect.north,
            west_edge: rect.west,
            gsd,
            width: (rect.width() / gsd).ceil().max(1.0) as usize,
            height: (rect.height() / gsd).ceil().max(1.0) as usize,
        }
    }

    /// The part that touches `rect`, cut at pixels, and the column and row at which it begins; `None`
    /// if nothing does.
    pub fn touching(&self, rect: &GroundRect) -> Option<(Self, (usize, usize))> {
        let cut = |metres: f64, size: usize| (metres / self.gsd).clamp(0.0, size as f64);
        let left = cut(rect.west - self.west_edge, self.width).floor() as usize;
        let right = cut(rect.east - self.west_edge, self.width).ceil() as usize;
        let top = cut(self.north_edge - rect.north, self.height).floor() as usize;
        let bottom = cut(self.north_edge - rect.south, self.height).ceil() as usize;
        let part = || Self {
            north_edge: self.north_edge - top as f64 * self.gsd,
            west_edge: self.west_edge + left as f64 * self.gsd,
            gsd: self.gsd,
            width: right - left,
            height: bottom - top,
        };
        (right > left && bottom > top).then(|| (part(), (left, top)))
    }

    /// Ground point at pixel (x, y), pixel centres at half integers.
    pub fn ground_at(&self, x: f64, y: f64) -> GroundPoint {
        GroundPoint::new(
            self.north_edge - y * self.gsd,
            self.west_edge + x * self.gsd,
        )
    }

    /// Pixel (x, y) of a ground point, pixel centres at half integers.
    pub fn pixel_at(&self, p: &GroundPoint) -> (f64, f64) {
        (
            (p.east - self.west_edge) / self.gsd,
            (self.north_edge - p.north) / self.gsd,
        )
    }

    /// The ground that the window covers.
    pub fn rect(&self) -> GroundRect {
        GroundRect {
            north: self.north_edge,
            south: self.north_edge - self.height as f64 * self.gsd,
            west: self.west_edge,
            east: self.west_edge + self.width as f64 * self.gsd,
        }
    }
}

/// A picture of the ground from which any window can be asked at any scale.
pub trait Imagery: Send + Sync {
    /// A short name for people.
    fn name(&self) -> &str;

    /// The ground that has pixels.
    fn bounds(&self) -> GroundRect;

    /// The finest ground sample distance that carries detail, metres per pixel.
    fn native_gsd(&self) -> f64;

    /// The pixels of `window`, anti-aliased for its ground sample distance.
    ///
    /// Pixels without data are transparent black.
    fn window(&self, window: &Window) -> Raster<Rgba>;

    /// The imagery whose ground this one shows, if it only keeps or changes what another gives: what it does not say itself
    /// is as of that one.
    fn source(&self) -> Option<&dyn Imagery> {
        None
    }

    /// Whether a coarser window of the same ground costs less than a fine one. Not so for ground that
    /// is made as it is looked at: a coarse pixel is the mean of many fine ones.
    fn is_coarse_cheap(&self) -> bool {
        self.source().is_none_or(Imagery::is_coarse_cheap)
    }

    /// The window without waiting for what takes long: what is not there yet is transparent. Also
    /// says whether the window is whole; if not, [`prepare`](Self::prepare) and ask again.
    fn window_so_far(&self, window: &Window) -> (Raster<Rgba>, bool) {
        (self.window(window), true)
    }

    /// Does up to so many pieces of what takes long ahead of its use; gives the number of pieces
    /// that are done and of all. A map that is quick everywhere has none.
    fn prepare(&self, pieces: usize) -> (usize, usize) {
        let done = |source: &dyn Imagery| source.prepare(pieces);
        self.source().map_or((0, 0), done)
    }

    /// Who made the map, in words that have to be shown with it, if the map says so itself.
    fn attribution(&self) -> Option<&str> {
        self.source()?.attribution()
    }

    /// Parts that could not be read and are shown as empty, in words: the first few, each once.
    fn problems(&self) -> Vec<String> {
        self.source().map_or_else(Vec::new, Imagery::problems)
    }
}

impl<T: Imagery + ?Sized> Imagery for std::sync::Arc<T> {
    fn name(&self) -> &str {
        (**self).name()
    }

    fn bounds(&self) -> GroundRect {
        (**self).bounds()
    }

    fn native_gsd(&self) -> f64 {
        (**self).native_gsd()
    }

    fn window(&self, window: &Window) -> Raster<Rgba> {
        (**self).window(window)
    }

    fn source(&self) -> Option<&dyn Imagery> {
        (**self).source()
    }

    fn is_coarse_cheap(&self) -> bool {
        (**self).is_coarse_cheap()
    }

    fn window_so_far(&self, window: &Window) -> (Raster<Rgba>, bool) {
        (**self).window_so_far(window)
    }

    fn prepare(&self, pieces: usize) -> (usize, usize) {
        (**self).prepare(pieces)
    }

    fn attribution(&self) -> Option<&str> {
        (**self).attribution()
    }

    fn problems(&self) -> Vec<String> {
        (**self).problems()
    }
}
