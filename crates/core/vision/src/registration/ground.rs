//! Ground seen from above: the map's and the frame's, made alike.

use super::look::{FrameLook, MapPose};
use pilotage_base::frames::GroundRect;
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{Gray, IntegralImage};

pub use crate::texture::Texture;

/// A north-up picture of ground with what of it is covered.
#[derive(Debug)]
pub struct GroundPicture {
    /// Ground that the picture shows.
    pub window: Window,
    /// Channels that are compared, one or several; zero where nothing is covered.
    pub channels: Vec<Gray>,
    /// Mask: 1 where the ground is covered, else 0.
    pub covered: Gray,
    /// Sums of the cover, for whole patches at a glance.
    cover: IntegralImage,
}

impl GroundPicture {
    fn new(
        window: Window,
        luminance: &Gray,
        covered: Gray,
        texture: Texture,
        radius: usize,
    ) -> Self {
        let (channels, covered) = texture.channels(luminance, covered, radius);
        Self {
            window,
            cover: IntegralImage::new(&covered),
            channels,
            covered,
        }
    }

    /// `map` over `rect`; for contrast, `radius` pixels of surroundings on each side decide what is bright.
    pub fn of_map(
        map: &dyn Imagery,
        rect: &GroundRect,
        gsd: f64,
        texture: Texture,
        radius: usize,
    ) -> Self {
        let window = Window::covering(rect, gsd);
        let pixels = map.window(&window);
        let covered = pixels.map(|p| if p[3] == 255 { 1.0 } else { 0.0 });
        Self::new(window, &pixels.to_gray(), covered, texture, radius)
    }

    /// The part of `window` that a frame shows, under its assumed pose.
    pub fn of_frame(
        look: &FrameLook<'_>,
        place: &MapPose,
        window: &Window,
        texture: Texture,
        radius: usize,
    ) -> Self {
        let seen = look.rectified(place, window);
        let covered = if seen.complete {
            Gray::filled(window.width, window.height, 1.0)
        } else {
            seen.seen
        };
        Self::new(*window, &seen.luminance, covered, texture, radius)
    }

    /// Share of a rectangle of pixels that is covered, 0 where it reaches outside.
    pub fn covered(&self, column: usize, row: usize, width: usize, height: usize) -> f64 {
        let inside = column + width <= self.window.width && row + height <= self.window.height;
        if inside && width * height > 0 {
            self.cover.sum(column, row, width, height) / (width * height) as f64
        } else {
            0.0
        }
    }
}
