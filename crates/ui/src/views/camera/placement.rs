//! The place of the camera picture on the screen.

use egui::{Pos2, Rect, vec2};
use nalgebra::Point2;

/// From pixels of the camera picture to points on the screen.
#[derive(Clone, Copy)]
pub(super) struct CameraPlacement {
    /// The whole picture on the screen.
    pub rect: Rect,
    /// Points per pixel.
    pub scale: f32,
}

impl CameraPlacement {
    /// Place of a pixel on the screen.
    pub fn at(&self, pixel: &Point2<f64>) -> Pos2 {
        self.rect.min + self.scale * vec2(pixel.x as f32, pixel.y as f32)
    }
}
