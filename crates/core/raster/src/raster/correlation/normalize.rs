//! From the plain correlation to the coefficient.

use super::surface::CorrelationSurface;
use crate::raster::integral::WindowCorners;
use crate::raster::simd::{self, CoefficientScale};
use crate::raster::{Gray, IntegralImage};

/// The sums of a picture over windows of one size.
pub(super) struct WindowSums<'a> {
    pub sums: &'a IntegralImage,
    pub squares: &'a IntegralImage,
    /// Columns and rows of a window.
    pub size: (usize, usize),
}

/// Divides by the energy of every window and the norm of the template; windows with an energy up to
/// `limit` become 0.
pub(super) fn normalize(
    numerator: &CorrelationSurface,
    windows: &WindowSums<'_>,
    (columns, rows): (usize, usize),
    norm: f64,
    limit: f64,
) -> Gray {
    let scale = CoefficientScale {
        per_area: 1.0 / (windows.size.0 * windows.size.1) as f64,
        per_norm: (1.0 / norm) as f32,
        limit,
    };
    let mut surface = Gray::filled(columns, rows, 0.0);
    for row in 0..rows {
        simd::coefficients(
            &numerator.values[row * numerator.stride..][..columns],
            &WindowCorners::of(windows.sums, row, windows.size),
            &WindowCorners::of(windows.squares, row, windows.size),
            &scale,
            surface.row_mut(row),
        );
    }
    surface
}
