//! A photo as it lies on the map, brought to the screen.

use egui::{ColorImage, TextureHandle, TextureOptions};
use pilotage_core::imagery::Window;
use pilotage_core::registration::Draped;

/// A photo as it lies on the map.
pub(super) struct DrapedPhoto {
    /// Place of its pixels on the ground, north up.
    pub(super) window: Window,
    /// Its pixels on the screen.
    pub(super) texture: TextureHandle,
}

impl DrapedPhoto {
    /// Brings its pixels to the screen.
    pub(super) fn new(draped: &Draped, egui: &egui::Context) -> Self {
        let (width, height) = (draped.pixels.width(), draped.pixels.height());
        let pixels = draped.pixels.pixels().as_flattened();
        let image = ColorImage::from_rgba_unmultiplied([width, height], pixels);
        Self {
            window: draped.window,
            texture: egui.load_texture("photo", image, TextureOptions::LINEAR),
        }
    }
}
