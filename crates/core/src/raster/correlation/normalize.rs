//! From the plain correlation to the coefficient.

use super::search::Surface;
use crate::raster::{Gray, IntegralImage};

/// The sums of a picture over windows of one size.
pub(super) struct Windows<'a> {
    pub sums: &'a IntegralImage,
    pub squares: &'a IntegralImage,
    pub size: (usize, usize),
}

/// Divides by the energy of every window and the norm of the template; windows with an energy up to
/// `limit` become 0.
pub(super) fn normalize(
    numerator: Surface,
    windows: &Windows<'_>,
    (columns, rows): (usize, usize),
    norm: f64,
    limit: f64,
) -> Gray {
    let (width, height) = windows.size;
    let per_area = 1.0 / (width * height) as f64;
    let norm_squared = norm * norm;
    let stride = numerator.stride;
    let mut out = numerator.values;
    let mut line = vec![0.0f32; columns];
    for row in 0..rows {
        let sums = Corners::of(windows.sums, row, height, width, columns);
        let squares = Corners::of(windows.squares, row, height, width, columns);
        let source = &out[row * stride..][..columns];
        for x in 0..columns {
            let sum = sums.at(x);
            let energy = squares.at(x) - sum * sum * per_area;
            let divisor = (energy.max(f64::MIN_POSITIVE) * norm_squared).sqrt();
            let value = f64::from(source[x]) / divisor;
            let value = if energy > limit { value } else { 0.0 };
            line[x] = value.clamp(-1.0, 1.0) as f32;
        }
        // Rows move together: columns <= stride, so nothing unread is overwritten.
        out[row * columns..][..columns].copy_from_slice(&line);
    }
    out.truncate(columns * rows);
    Gray::from_pixels(columns, rows, out).unwrap_or_else(|| Gray::filled(0, 0, 0.0))
}

/// The four corners of all windows in a row, as slices of one length so that the loop vectorizes.
struct Corners<'a> {
    top_left: &'a [f64],
    top_right: &'a [f64],
    bottom_left: &'a [f64],
    bottom_right: &'a [f64],
}

impl<'a> Corners<'a> {
    fn of(
        table: &'a IntegralImage,
        row: usize,
        height: usize,
        width: usize,
        columns: usize,
    ) -> Self {
        let (top, bottom) = (table.line(row), table.line(row + height));
        Self {
            top_left: &top[..columns],
            top_right: &top[width..][..columns],
            bottom_left: &bottom[..columns],
            bottom_right: &bottom[width..][..columns],
        }
    }

    #[inline]
    fn at(&self, x: usize) -> f64 {
        self.bottom_right[x] - self.bottom_left[x] - self.top_right[x] + self.top_left[x]
    }
}
