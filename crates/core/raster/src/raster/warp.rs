//! Pictures looked at through a plane transform.

use nalgebra::{Matrix3, Point2};

use super::{Gray, Raster, Rgb};

/// A pixel type that can be interpolated.
pub trait PixelValue: Copy {
    /// (1 - t)·a + t·b for two neighbours across and two down, as weights of the four.
    fn blend(four: [Self; 4], weights: [f32; 4]) -> Self;
}

impl PixelValue for f32 {
    fn blend(four: [Self; 4], weights: [f32; 4]) -> Self {
        four[0] * weights[0] + four[1] * weights[1] + four[2] * weights[2] + four[3] * weights[3]
    }
}

impl PixelValue for Rgb {
    fn blend(four: [Self; 4], w: [f32; 4]) -> Self {
        std::array::from_fn(|c| {
            let v = f32::from(four[0][c]) * w[0]
                + f32::from(four[1][c]) * w[1]
                + f32::from(four[2][c]) * w[2]
                + f32::from(four[3][c]) * w[3];
            (v + 0.5) as u8
        })
    }
}

impl<T: PixelValue> Raster<T> {
    /// The value at (x, y) by bilinear interpolation, pixel centres at half integers; `None`
    /// outside of the picture. In the outer half pixel the edge is continued.
    pub fn sample(&self, x: f64, y: f64) -> Option<T> {
        let inside = x >= 0.0 && y >= 0.0 && x <= self.width() as f64 && y <= self.height() as f64;
        (inside && !self.is_empty()).then(|| self.sample_continued(x, y))
    }

    /// As [`Self::sample`], with the edge continued outward; the picture must have a pixel.
    pub fn sample_continued(&self, x: f64, y: f64) -> T {
        let place = |v: f64, length: usize| {
            let v = (v - 0.5).clamp(0.0, (length - 1) as f64);
            // Not a number ends at 0.
            let index = (v as usize).min(length - 1);
            (
                index,
                (index + 1).min(length - 1),
                (v - index as f64) as f32,
            )
        };
        let (left, right, u) = place(x, self.width());
        let (top, bottom, v) = place(y, self.height());
        let (above, below) = (self.row(top), self.row(bottom));
        T::blend(
            [above[left], above[right], below[left], below[right]],
            [(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v],
        )
    }
}

/// A picture of the given size whose pixel p shows `source` at `source_from_target` · p, bilinear;
/// `outside` where that lies outside of the source.
///
/// The matrix is projective and acts on (x, y, 1) with pixel centres at half integers on both
/// sides. It does not smooth: halve the source first when the target is coarser.
///
/// ```
/// use nalgebra::Matrix3;
/// use pilotage_raster::raster::{Gray, warp_projective};
///
/// let source = Gray::from_fn(6, 4, |column, row| (10 * row + column) as f32);
/// // The target shows what lies two pixels to the right and one down.
/// let source_from_target = Matrix3::new(1., 0., 2., 0., 1., 1., 0., 0., 1.);
/// let moved = warp_projective(&source, &source_from_target, 6, 4, -1.0);
/// assert_eq!(moved.get(0, 0), source.get(2, 1));
/// assert_eq!(moved.get(5, 0), -1.0);
/// ```
pub fn warp_projective<T: PixelValue>(
    source: &Raster<T>,
    source_from_target: &Matrix3<f64>,
    width: usize,
    height: usize,
    outside: T,
) -> Raster<T> {
    let m = source_from_target;
    let mut out = Raster::filled(width, height, outside);
    for row in 0..height {
        let y = row as f64 + 0.5;
        for (column, value) in out.row_mut(row).iter_mut().enumerate() {
            let p = m * nalgebra::Vector3::new(column as f64 + 0.5, y, 1.0);
            if p.z > 0.0
                && let Some(sample) = source.sample(p.x / p.z, p.y / p.z)
            {
                *value = sample;
            }
        }
    }
    out
}

/// A patch of the given size around `center` of the source, turned by `angle` radians (clockwise on
/// the picture) and magnified by `scale`, bilinear; `None` if it reaches outside.
///
/// Pixel offsets d from the middle of the patch show the source at center + R(angle) d / scale.
pub fn warp_similar(
    source: &Gray,
    center: &Point2<f64>,
    angle: f64,
    scale: f64,
    width: usize,
    height: usize,
) -> Option<Gray> {
    let (sin, cos) = (angle.sin() / scale, angle.cos() / scale);
    let (half_width, half_height) = (0.5 * width as f64, 0.5 * height as f64);
    let place = |x: f64, y: f64| {
        let (dx, dy) = (x - half_width, y - half_height);
        (
            center.x + cos * dx - sin * dy,
            center.y + sin * dx + cos * dy,
        )
    };
    let inside = |(x, y): (f64, f64)| {
        (0.0..=source.width() as f64).contains(&x) && (0.0..=source.height() as f64).contains(&y)
    };
    let (right, bottom) = (width as f64, height as f64);
    let corners = [(0.0, 0.0), (right, 0.0), (0.0, bottom), (right, bottom)];
    if width * height == 0 || !corners.into_iter().all(|(x, y)| inside(place(x, y))) {
        return None;
    }
    Some(Gray::from_fn(width, height, |column, row| {
        let (x, y) = place(column as f64 + 0.5, row as f64 + 0.5);
        source.sample_continued(x, y)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn plane(x: f64, y: f64) -> f64 {
        2.0 * x - 0.7 * y + 3.0
    }

    /// A picture whose pixels hold a linear function of the place of their centre.
    fn picture() -> Gray {
        Gray::from_fn(40, 30, |c, r| plane(c as f64 + 0.5, r as f64 + 0.5) as f32)
    }

    proptest! {
        #[test]
        fn bilinear_sampling_is_exact_on_a_plane(x in 0.5..39.5f64, y in 0.5..29.5f64) {
            let value = f64::from(picture().sample(x, y).unwrap());
            prop_assert!((value - plane(x, y)).abs() < 1e-4);
        }

        #[test]
        fn a_turned_patch_shows_the_source_where_it_says(
            angle in -3.0..3.0f64, scale in 0.8..2.0f64, column in 0usize..8, row in 0usize..6,
        ) {
            let center = Point2::new(20.3, 14.6);
            let patch = warp_similar(&picture(), &center, angle, scale, 8, 6).unwrap();
            let d = nalgebra::Vector2::new(column as f64 - 3.5, row as f64 - 2.5) / scale;
            let p = center + nalgebra::Rotation2::new(angle) * d;
            prop_assert!((f64::from(patch.get(column, row)) - plane(p.x, p.y)).abs() < 1e-3);
        }
    }

    #[test]
    fn outside_of_the_picture_there_is_nothing() {
        let picture = picture();
        assert_eq!(picture.sample(-0.01, 3.0), None);
        assert_eq!(picture.sample(40.01, 3.0), None);
        assert_eq!(picture.sample(f64::NAN, 3.0), None);
        assert_eq!(picture.sample(0.0, 0.0), Some(picture.get(0, 0)));
        assert_eq!(Gray::filled(0, 0, 0.0).sample(0.0, 0.0), None);
        assert!(warp_similar(&picture, &Point2::new(3.0, 3.0), 0.1, 1.0, 8, 8).is_none());
    }

    #[test]
    fn a_projective_warp_places_each_pixel_through_the_matrix() {
        let m = Matrix3::new(0.8, 0.1, 4.0, -0.05, 0.7, 5.0, 0.002, -0.001, 1.0);
        let out = warp_projective(&picture(), &m, 20, 20, -1.0);
        let p = m * nalgebra::Vector3::new(7.5, 11.5, 1.0);
        let expected = plane(p.x / p.z, p.y / p.z);
        assert!((f64::from(out.get(7, 11)) - expected).abs() < 1e-3);
        let away = m.append_translation(&nalgebra::Vector2::new(900.0, 0.0));
        let out = warp_projective(&picture(), &away, 4, 4, -1.0);
        assert!(out.pixels().iter().all(|&v| v == -1.0));
    }
}
