//! The ground under the pixels of a picture, made affine.

use nalgebra::{Matrix2, Point2, Vector2};
use serde::{Deserialize, Serialize};

use super::{Georeference, GeoreferenceError};
use crate::frames::{GroundPoint, LocalFrame};

/// Farthest from its middle that the affine map of a picture is stretched to, metres: beyond, the ground
/// bends away from the plane by more than the map would be of use.
const AFFINE_REACH: f64 = 200_000.0;

/// Places along each side of a picture that are tried where its middle lies beyond the plane.
const PLACES: usize = 9;

/// Ground coordinates (north, east) as an affine function of the pixel, centres at half integers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GroundFromPixel {
    /// Change of (north, east) per pixel: first column per pixel to the right, second per pixel down.
    pub matrix: Matrix2<f64>,
    /// (north, east) of the outer corner of the top-left pixel, metres.
    pub corner: Vector2<f64>,
}

impl GroundFromPixel {
    /// A north-up picture with its top-left corner at `corner` and square pixels of `gsd` metres.
    ///
    /// ```
    /// use nalgebra::Point2;
    /// use pilotage_base::{frames::GroundPoint, georeference::GroundFromPixel};
    ///
    /// // A corner 100 m north of the origin, pixels of 2 m.
    /// let ground_from_pixel = GroundFromPixel::north_up(GroundPoint::new(100.0, 0.0), 2.0);
    /// let ground = ground_from_pixel.ground_at(&Point2::new(10.0, 5.0));
    /// assert_eq!(ground, GroundPoint::new(90.0, 20.0));
    /// assert_eq!(ground_from_pixel.gsd(), 2.0);
    /// ```
    pub fn north_up(corner: GroundPoint, gsd: f64) -> Self {
        Self {
            matrix: Matrix2::new(0.0, -gsd, gsd, 0.0),
            corner: corner.to_vector(),
        }
    }

    /// Ground point of a pixel, centres at half integers.
    pub fn ground_at(&self, pixel: &Point2<f64>) -> GroundPoint {
        GroundPoint::from(self.matrix * pixel.coords + self.corner)
    }

    /// Pixel of a ground point, centres at half integers; `None` if the map does not span an area.
    pub fn pixel_at(&self, ground: &GroundPoint) -> Option<Point2<f64>> {
        let inverse = self.matrix.try_inverse()?;
        Some(Point2::from(inverse * (ground.to_vector() - self.corner)))
    }

    /// Ground sample distance: the side of a square with a pixel's area, metres.
    pub fn gsd(&self) -> f64 {
        self.matrix.determinant().abs().sqrt()
    }
}

impl Georeference {
    /// The affine map for a picture of the given size in the world frame `frame`: around its middle, or
    /// around the pixel at the world's origin where the middle lies beyond the plane.
    ///
    /// Coordinates on the globe are not affine in the tangent plane; over a kilometre the difference
    /// is below a decimetre, and the middle and two sides of the picture are met, of a picture of more
    /// than 400 km its middle part. `Placement` is exact.
    pub fn in_world(
        &self,
        frame: &LocalFrame,
        width: usize,
        height: usize,
    ) -> Result<GroundFromPixel, GeoreferenceError> {
        let size = Vector2::new(width.max(1) as f64, height.max(1) as f64);
        let middle = Point2::from(0.5 * size);
        let is_inside =
            |p: &Point2<f64>| (0.0..=size.x).contains(&p.x) && (0.0..=size.y).contains(&p.y);
        let is_near = |p: &Point2<f64>| self.ground_at(frame, p.x, p.y).north.is_finite();
        if is_near(&middle) {
            return self
                .around(frame, &middle, &size)
                .ok_or(GeoreferenceError::Degenerate);
        }
        if self.place_at(middle.x, middle.y).is_none() {
            return Err(GeoreferenceError::Degenerate);
        }
        let origin = self.pixel_near(frame, &GroundPoint::default(), &middle);
        // At a pole, where meridians meet, a place beside it.
        let places = (0..PLACES * PLACES).map(|i| {
            let place = Vector2::new((i % PLACES) as f64 + 0.5, (i / PLACES) as f64 + 0.5);
            Point2::from(place.component_mul(&size) / PLACES as f64)
        });
        let origin = origin.filter(is_inside).into_iter();
        let mut near = origin.chain(places).filter(is_near);
        near.find_map(|place| self.around(frame, &place, &size))
            .ok_or(GeoreferenceError::TooFar)
    }

    /// The affine map around a pixel of a picture; `None` if it spans no area there.
    fn around(
        &self,
        frame: &LocalFrame,
        pixel: &Point2<f64>,
        size: &Vector2<f64>,
    ) -> Option<GroundFromPixel> {
        let at = |x: f64, y: f64| self.ground_at(frame, x, y).to_vector();
        let centre = at(pixel.x, pixel.y);
        let is_near = |p: &Vector2<f64>| (p - centre).norm() <= AFFINE_REACH;
        // A difference across the pixel, over as much of the picture as lies near the plane.
        let across = |step: Vector2<f64>| {
            let mut half = 0.5 * step;
            for _ in 0..64 {
                let ends = [-half, half].map(|half| at(pixel.x + half.x, pixel.y + half.y));
                // Not so of what is not a number.
                if ends.iter().all(is_near) {
                    return Some((ends[1] - ends[0]) / (2.0 * half.norm()));
                }
                half *= 0.5;
            }
            None
        };
        let per_x = across(Vector2::new(size.x, 0.0))?;
        let per_y = across(Vector2::new(0.0, size.y))?;
        let map = GroundFromPixel {
            matrix: Matrix2::from_columns(&[per_x, per_y]),
            corner: centre - pixel.x * per_x - pixel.y * per_y,
        };
        let area = map.matrix.determinant().abs();
        (area.is_finite() && area > 1e-12 && map.corner.norm().is_finite()).then_some(map)
    }
}
