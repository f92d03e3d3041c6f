//! What is left of a picture when light and haze are taken away.

use pilotage_raster::raster::{Gray, IntegralImage};

/// Contrast below this, grey levels, is noise of the camera and of the file rather than texture.
const NOISE: f64 = 2.0;

/// Each covered pixel's deviation from the mean of its surroundings (a square `radius` pixels to each
/// side) in units of their standard deviation; zero where nothing is covered.
///
/// Only covered pixels count, so that the edge of the picture leaves no step. Pictures of different
/// exposure, white balance and shade come out alike.
pub fn local_contrast(luminance: &Gray, covered: &Gray, radius: usize) -> Gray {
    let (width, height) = (luminance.width(), luminance.height());
    let mut masked = luminance.clone();
    for (value, cover) in masked.pixels_mut().iter_mut().zip(covered.pixels()) {
        *value *= cover;
    }
    let counts = IntegralImage::new(covered);
    let sums = IntegralImage::new(&masked);
    let squares = IntegralImage::of_squares(&masked);
    Gray::from_fn(width, height, |column, row| {
        if covered.get(column, row) == 0.0 {
            return 0.0;
        }
        let (left, top) = (column.saturating_sub(radius), row.saturating_sub(radius));
        let across = (column + radius + 1).min(width) - left;
        let down = (row + radius + 1).min(height) - top;
        let count = counts.sum(left, top, across, down);
        let mean = sums.sum(left, top, across, down) / count;
        let variance = squares.sum(left, top, across, down) / count - mean * mean;
        let deviation = (variance.max(0.0) + NOISE * NOISE).sqrt();
        ((f64::from(luminance.get(column, row)) - mean) / deviation) as f32
    })
}
