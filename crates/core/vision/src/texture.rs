//! Texture of the ground that is compared: a picture with light and haze taken away, as one channel or
//! several.

use pilotage_raster::raster::{Gray, IntegralImage, OrientationField, gaussian_blur};

/// Texture of the ground that is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Texture {
    /// Brightness against the surroundings: fine and exact where map and frame are of one day.
    Contrast,
    /// Edges, where they run and how, which stay from one date and sensor to another.
    Edges,
    /// Edges and, with less weight, contrast: tells one place from another better than either, but shadows and
    /// crops move its summit.
    EdgesAndContrast,
}

/// Weight of contrast beside edges.
const CONTRAST: f32 = 0.3;
/// Limit at which contrast is clipped, standard deviations.
const CLIPPED: f32 = 2.0;
/// Standard deviation over which it is smoothed, pixels, as edges are.
const SMOOTHED: f64 = 1.2;
/// Pixels to each side that decide what is bright beside edges.
const SURROUNDINGS: usize = 12;

impl Texture {
    /// The channels of a picture of which `covered` (one, else zero) is known, and where they are known; for
    /// contrast alone, `radius` pixels of surroundings on each side decide what is bright.
    pub fn channels(self, luminance: &Gray, covered: Gray, radius: usize) -> (Vec<Gray>, Gray) {
        match self {
            Self::Contrast => (vec![local_contrast(luminance, &covered, radius)], covered),
            Self::Edges => {
                let field = OrientationField::new(luminance, &covered);
                (field.channels, field.covered)
            }
            Self::EdgesAndContrast => {
                let mut field = OrientationField::new(luminance, &covered);
                let smooth = gaussian_blur(luminance, SMOOTHED);
                let contrast = local_contrast(&smooth, &field.covered, SURROUNDINGS);
                let weighed = |v: f32| CONTRAST * v.clamp(-CLIPPED, CLIPPED);
                field.channels.push(contrast.map(weighed));
                (field.channels, field.covered)
            }
        }
    }
}

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
    let [mut count, mut sum, mut square] = [0; 3].map(|_| vec![0.0; width]);
    let mut contrast = Gray::filled(width, height, 0.0);
    for row in 0..height {
        counts.sums_around(row, radius, &mut count);
        sums.sums_around(row, radius, &mut sum);
        squares.sums_around(row, radius, &mut square);
        let lines = luminance.row(row).iter().zip(covered.row(row));
        let lines = lines.zip(&count).zip(&sum).zip(&square);
        for (out, ((((&value, &cover), count), sum), square)) in
            contrast.row_mut(row).iter_mut().zip(lines)
        {
            let mean = sum / count;
            let variance = square / count - mean * mean;
            let deviation = (variance.max(0.0) + NOISE * NOISE).sqrt();
            let relative = ((f64::from(value) - mean) / deviation) as f32;
            *out = if cover == 0.0 { 0.0 } else { relative };
        }
    }
    contrast
}
