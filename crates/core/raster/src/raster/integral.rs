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

    /// Sums over the squares of `radius` pixels to each side around the pixels of row `row`, cut at the edges of the
    /// picture.
    ///
    /// # Panics
    /// If `sums` has not one place for each pixel of the row.
    ///
    /// ```
    /// use pilotage_raster::raster::{Gray, IntegralImage};
    ///
    /// let table = IntegralImage::new(&Gray::filled(4, 3, 1.0));
    /// let mut sums = [0.0; 4];
    /// table.sums_around(0, 1, &mut sums);
    /// assert_eq!(sums, [4.0, 6.0, 6.0, 4.0]);
    /// ```
    pub fn sums_around(&self, row: usize, radius: usize, sums: &mut [f64]) {
        let width = self.stride - 1;
        assert_eq!(sums.len(), width, "sums for another width");
        let top = self.line(row.saturating_sub(radius));
        let bottom = self.line((row + radius + 1).min(self.rows - 1));
        let sum = |left: usize, right: usize| bottom[right] - bottom[left] - top[right] + top[left];
        let inner = if width > 2 * radius {
            radius..width - radius
        } else {
            0..0
        };
        let (before, behind) = (0..inner.start, inner.end..width);
        for x in before.chain(behind) {
            sums[x] = sum(x.saturating_sub(radius), (x + radius + 1).min(width));
        }
        let across = 2 * radius + 1;
        let count = inner.len();
        let (top_left, top_right) = (&top[..count], &top[across.min(width)..][..count]);
        let (bottom_left, bottom_right) = (&bottom[..count], &bottom[across.min(width)..][..count]);
        for (n, sum) in sums[inner].iter_mut().enumerate() {
            *sum = bottom_right[n] - bottom_left[n] - top_right[n] + top_left[n];
        }
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

        #[test]
        fn sums_around_the_pixels_of_a_row_are_those_of_their_squares(
            width in 1usize..40,
            height in 1usize..9,
            radius in 0usize..12,
            values in proptest::collection::vec(-100.0..100.0f32, 40 * 9),
            place in 0.0..1.0f64,
        ) {
            let picture = Gray::from_fn(width, height, |x, y| values[y * 40 + x]);
            let table = IntegralImage::new(&picture);
            let row = (place * height as f64) as usize;
            let mut sums = vec![0.0; width];
            table.sums_around(row, radius, &mut sums);
            let top = row.saturating_sub(radius);
            let down = (row + radius + 1).min(height) - top;
            for (x, sum) in sums.iter().enumerate() {
                let left = x.saturating_sub(radius);
                let across = (x + radius + 1).min(width) - left;
                prop_assert_eq!(*sum, table.sum(left, top, across, down));
            }
        }
    }
}
