//! Gradient of brightness: its amount and its direction.

use super::Gray;

/// First derivatives of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradient {
    /// Derivative to the right, grey levels per pixel.
    pub x: Gray,
    /// Derivative downward, grey levels per pixel.
    pub y: Gray,
}

impl Gradient {
    /// Sobel's operator (smoothing 1-2-1), in grey levels per pixel; the picture is mirrored at its
    /// edges.
    ///
    /// ```
    /// use pilotage_raster::raster::{Gradient, Gray};
    ///
    /// // A ramp that rises by 3 grey levels per pixel to the right and falls by 2 downward.
    /// let ramp = Gray::from_fn(8, 8, |column, row| 3.0 * column as f32 - 2.0 * row as f32);
    /// let gradient = Gradient::sobel(&ramp);
    /// assert_eq!((gradient.x.get(4, 4), gradient.y.get(4, 4)), (3.0, -2.0));
    /// ```
    pub fn sobel(picture: &Gray) -> Self {
        Self::separable(picture, 2.0, 1.0)
    }

    /// Scharr's operator (smoothing 3-10-3), whose direction is truer than Sobel's.
    pub fn scharr(picture: &Gray) -> Self {
        Self::separable(picture, 10.0, 3.0)
    }

    /// Central differences smoothed across by (side, middle, side), normalized.
    fn separable(picture: &Gray, middle: f32, side: f32) -> Self {
        let (width, height) = (picture.width(), picture.height());
        let mut gradient = Self {
            x: Gray::filled(width, height, 0.0),
            y: Gray::filled(width, height, 0.0),
        };
        if picture.is_empty() {
            return gradient;
        }
        let scale = 0.5 / (middle + 2.0 * side);
        let (middle, side) = (middle * scale, side * scale);
        // Smoothed down the columns, and differences down the columns, one spare at each end.
        let mut smooth = vec![0.0f32; width + 2];
        let mut change = vec![0.0f32; width + 2];
        for row in 0..height {
            let above = picture.row(mirrored(row, -1, height));
            let here = picture.row(row);
            let below = picture.row(mirrored(row, 1, height));
            for column in 0..width {
                smooth[column + 1] = middle * here[column] + side * (above[column] + below[column]);
                change[column + 1] = below[column] - above[column];
            }
            for line in [&mut smooth, &mut change] {
                line[0] = line[1 + mirrored(0, -1, width)];
                line[width + 1] = line[1 + mirrored(width - 1, 1, width)];
            }
            let target = gradient.x.row_mut(row);
            for (column, value) in target.iter_mut().enumerate() {
                *value = smooth[column + 2] - smooth[column];
            }
            let target = gradient.y.row_mut(row);
            for (column, value) in target.iter_mut().enumerate() {
                *value = middle * change[column + 1] + side * (change[column] + change[column + 2]);
            }
        }
        gradient
    }

    /// Length of the gradient, grey levels per pixel.
    pub fn magnitude(&self) -> Gray {
        self.combine(|x, y| (x * x + y * y).sqrt())
    }

    /// Direction in which brightness rises fastest, radians from right towards down, in (-π, π].
    pub fn orientation(&self) -> Gray {
        self.combine(|x, y| y.atan2(x))
    }

    fn combine(&self, f: impl Fn(f32, f32) -> f32) -> Gray {
        let mut out = self.x.clone();
        for (value, &y) in out.pixels_mut().iter_mut().zip(self.y.pixels()) {
            *value = f(*value, y);
        }
        out
    }
}

/// `index + step` (one away) mirrored at the ends of `0..length`, the end itself not repeated.
fn mirrored(index: usize, step: isize, length: usize) -> usize {
    match index.checked_add_signed(step) {
        Some(next) if next < length => next,
        _ => index
            .checked_add_signed(-step)
            .filter(|&n| n < length)
            .unwrap_or(index),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_has_its_slope_everywhere_inside() {
        let plane = Gray::from_fn(9, 7, |x, y| 3.0 * x as f32 - 2.0 * y as f32 + 5.0);
        for gradient in [Gradient::sobel(&plane), Gradient::scharr(&plane)] {
            for y in 1..6 {
                for x in 1..8 {
                    assert!((gradient.x.get(x, y) - 3.0).abs() < 1e-5);
                    assert!((gradient.y.get(x, y) + 2.0).abs() < 1e-5);
                }
            }
            assert!((gradient.magnitude().get(4, 3) - 13f32.sqrt()).abs() < 1e-5);
            let expected = (-2.0f32).atan2(3.0);
            assert!((gradient.orientation().get(4, 3) - expected).abs() < 1e-6);
        }
    }

    #[test]
    fn a_single_row_has_no_change_downward() {
        let gradient = Gradient::sobel(&Gray::from_fn(5, 1, |x, _| x as f32));
        assert!(gradient.y.pixels().iter().all(|&v| v == 0.0));
        assert_eq!(gradient.x.get(2, 0), 1.0);
        assert!(Gradient::sobel(&Gray::filled(0, 0, 0.0)).x.is_empty());
    }
}
