//! Sums over any rectangle in four look-ups.

use super::Gray;

/// Summed-area table in double precision.
#[derive(Clone, Debug)]
pub struct IntegralImage {
    stride: usize,
    rows: usize,
    /// `sums[(r, c)]` is the sum of all pixels above row r and left of column c.
    sums: Vec<f64>,
}

impl IntegralImage {
    /// The table of `picture`.
    pub fn new(picture: &Gray) -> Self {
        Self::of(picture.pixels(), picture.width(), |value| value)
    }

    /// The table of the squares of `picture`.
    pub fn of_squares(picture: &Gray) -> Self {
        Self::of(picture.pixels(), picture.width(), |value| value * value)
    }

    /// The table of `f(pixel)`; `pixels` row by row, `width` pixels in each.
    pub(crate) fn of(pixels: &[f32], width: usize, f: impl Fn(f64) -> f64) -> Self {
        let height = pixels.len().checked_div(width).unwrap_or(0);
        let stride = width + 1;
        let mut sums = vec![0.0; stride * (height + 1)];
        // Four rows at a time, so that four chains of additions run side by side.
        let mut row = 0;
        while row < height {
            let together = (height - row).min(4);
            if together == 4 {
                let source: [&[f32]; 4] =
                    std::array::from_fn(|i| &pixels[(row + i) * width..][..width]);
                let mut running = [0.0f64; 4];
                let (a, rest) = sums[(row + 1) * stride..][..4 * stride].split_at_mut(stride);
                let (b, rest) = rest.split_at_mut(stride);
                let (c, d) = rest.split_at_mut(stride);
                for column in 0..width {
                    for (sum, line) in running.iter_mut().zip(source) {
                        *sum += f(f64::from(line[column]));
                    }
                    a[column + 1] = running[0];
                    b[column + 1] = running[1];
                    c[column + 1] = running[2];
                    d[column + 1] = running[3];
                }
            } else {
                for i in 0..together {
                    let mut running = 0.0;
                    let source = &pixels[(row + i) * width..][..width];
                    let target = &mut sums[(row + i + 1) * stride + 1..][..width];
                    for (sum, &value) in target.iter_mut().zip(source) {
                        running += f(f64::from(value));
                        *sum = running;
                    }
                }
            }
            for i in 0..together {
                let (above, below) = sums.split_at_mut((row + i + 1) * stride);
                let above = &above[(row + i) * stride..];
                for (sum, &upper) in below[..stride].iter_mut().zip(above) {
                    *sum += upper;
                }
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
    pub(crate) fn line(&self, row: usize) -> &[f64] {
        assert!(row < self.rows, "row {row} of a table of {}", self.rows);
        &self.sums[row * self.stride..][..self.stride]
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
