//! When a window is too flat to be compared.

/// A standard deviation below this part of the largest value counts as flat.
pub(super) const FLATNESS: f64 = 1e-5;

/// Energy per pixel below which a window of a picture with these pixels counts as flat.
pub(super) fn flat_level(pixels: &[f32]) -> f64 {
    let largest = pixels
        .iter()
        .fold(0.0f32, |largest, v| largest.max(v.abs()));
    (FLATNESS * f64::from(largest)).powi(2)
}
