//! A correlation surface as colours.

use egui::{Color32, ColorImage};
use pilotage_core::raster::Gray;

/// Colours from dark violet (unlike) over orange to pale yellow (alike), for values -1 to 1; the
/// steps are even to the eye and distinct without colour.
fn color(value: f32) -> Color32 {
    const STOPS: [[f32; 3]; 5] = [
        [10.0, 8.0, 34.0],
        [87.0, 16.0, 110.0],
        [188.0, 55.0, 84.0],
        [249.0, 142.0, 9.0],
        [252.0, 255.0, 164.0],
    ];
    let at = value.clamp(0.0, 1.0) * 4.0;
    let low = (at.floor() as usize).min(3);
    let part = at - low as f32;
    let mix = |i: usize| (STOPS[low][i] + part * (STOPS[low + 1][i] - STOPS[low][i])) as u8;
    Color32::from_rgb(mix(0), mix(1), mix(2))
}

/// The surface as a picture; negative correlation is as dark as none.
pub fn heat_image(surface: &Gray) -> ColorImage {
    ColorImage::new(
        [surface.width(), surface.height()],
        surface.pixels().iter().map(|v| color(*v)).collect(),
    )
}
