//! Sums over any rectangle in four look-ups.

use super::pool::Buffer;
use super::{Gray, simd};

/// Summed-area table in double precision.
#[derive(Clone, Debug)]
pub struct IntegralImage {
    stride: usize,
    rows: usize,
    /// `sums[(r, c)]` is the sum of all pixels above row r and left of column c.
    sums: Buffer<f64>,
}

impl IntegralImage {
    /// The table of `picture`.
    ///
    /// ```
    /// use pilotage_raster::raster::{Gray, IntegralImage};
    ///
    /// let table = IntegralImage::new(&Gray::from_fn(5, 5, |column, _| column as f32));
    /// // Columns 1 to 3 in two rows: 2 · (1 + 2 + 3).
    /// assert_eq!(table.sum(1, 2, 3, 2), 12.0);
    /// ```
    pub fn new(picture: &Gray) -> Self {
        Self::of(picture.pixels(), picture.width(), false)
    }

    /// The table of the squares of `picture`.
    pub fn of_squares(picture: &Gray) -> Self {
        Self::of(picture.pixels(), picture.width(), true)
    }

    /// The table of `pixels` or of their squares, row by row, `width` pixels in each.
    pub(super) fn of(pixels: &[f32], width: usize, squares: bool) -> Self {
        let height = pixels.len().checked_div(width).unwrap_or(0);
        let stride = width + 1;
        let mut sums = Buffer::<f64>::dirty(stride * (height + 1));
        sums[..stride].fill(0.0);
        let mut row = 0;
        while row < height {
            let together = (height - row).min(4);
            // Up to three rows at the end are summed with the last one again.
            let source =
                std::array::from_fn(|i| &pixels[(row + i.min(together - 1)) * width..][..width]);
            let target = &mut sums[(row + 1) * stride..];
            if together == 4 {
                simd::four_running_sums(source, squares, target, stride);
            } else {
                let mut rest = Buffer::<f64>::zeros(4 * stride);
                simd::four_running_sums(source, squares, &mut rest, stride);
                target[..together * stride].copy_from_slice(&rest[..together * stride]);
            }
            for i in row + 1..=row + together {
                let (above, below) = sums.split_at_mut(i * stride);
                simd::accumulate(&above[(i - 1) * stride..], &mut below[..stride]);
            }
            row += together;
        }
        Self {
            stride,
            rows: height + 1,
            sums,
        }
    }

    /// Sum over the rectangle that begins at (column, row); panics if it reaches outside.
    pub fn sum(&self, column: usize, row: usize, width: usize, height: usize) -> f64 {
        let top = self.line(row);
        let bottom = self.line(row + height);
        bottom[column + width] - bottom[column] - top[column + width] + top[column]
    }

    /// The table's row `row` (0 to the height of the picture), one entry more than the width.
    fn line(&self, row: usize) -> &[f64] {
        assert!(row < self.rows, "row {row} of a table of {}", self.rows);
        &self.sums[row * self.stride..][..self.stride]
    }
}

/// The four corners of all windows of one size in a row, as slices of one length so that loops over
/// them vectorize.
#[derive(Clone, Copy, Debug)]
pub(super) struct WindowCorners<'a> {
    top_left: &'a [f64],
    top_right: &'a [f64],
    bottom_left: &'a [f64],
    bottom_right: &'a [f64],
}

impl<'a> WindowCorners<'a> {
    /// Of the windows of `width` × `height` pixels with their top edge at `row`.
    pub fn of(table: &'a IntegralImage, row: usize, (width, height): (usize, usize)) -> Self {
        let (top, bottom) = (table.line(row), table.line(row + height));
        let count = table.stride - width;
        Self {
            top_left: &top[..count],
            top_right: &top[width..],
            bottom_left: &bottom[..count],
            bottom_right: &bottom[width..],
        }
    }

    /// The first `count` windows.
    #[inline]
    pub fn cut(&self, count: usize) -> Self {
        Self {
            top_left: &self.top_left[..count],
            top_right: &self.top_right[..count],
            bottom_left: &self.bottom_left[..count],
            bottom_right: &self.bottom_right[..count],
        }
    }

    /// Sum over the window at column `x`.
    #[inline]
    pub fn at(&self, x: usize) -> f64 {
        self.bottom_right[x] - self.bottom_left[x] - self.top_right[x] + self.top_left[x]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_sum_over_a_rectangle_is_the_sum_of_its_pixels(
            width in 1usize..14,
            height in 1usize..14,
            values in proptest::collection::vec(-100i16..100, 14 * 14),
            a in 0.0..1.0f64, b in 0.0..1.0f64, c in 0.0..1.0f64, d in 0.0..1.0f64,
        ) {
            let picture = Gray::from_fn(width, height, |x, y| f32::from(values[y * 14 + x]));
            let (x, y) = ((a * width as f64) as usize, (b * height as f64) as usize);
            let w = (c * (width - x) as f64) as usize;
            let h = (d * (height - y) as f64) as usize;
            let expected: f64 = (y..y + h)
                .flat_map(|r| (x..x + w).map(move |q| (q, r)))
                .map(|(q, r)| f64::from(picture.get(q, r)))
                .sum();
            prop_assert_eq!(IntegralImage::new(&picture).sum(x, y, w, h), expected);
        }
    }
}
