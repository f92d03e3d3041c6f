//! A straight road in a picture: distance and direction, as DeAngelo 2016 measures it.

use nalgebra::{Point2, Vector2};

/// A straight road as seen from a point of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StraightRoad {
    /// Distance of the point from the road, pixels, positive on the side of the direction turned from x to y.
    pub distance: f64,
    /// Direction of the road, of length 1.
    pub direction: Vector2<f64>,
}

impl StraightRoad {
    /// The road from `first` to `last` as `origin` sees it; `None` where the two are one point.
    ///
    /// DeAngelo 2016, eqs 47 and 48, with the sign of n × (p - L₁) where the thesis has the length alone: that has a
    /// kink at 0, exactly where an aircraft is that follows the road.
    pub fn of(first: Point2<f64>, last: Point2<f64>, origin: Point2<f64>) -> Option<Self> {
        let direction = (last - first).try_normalize(f64::MIN_POSITIVE)?;
        Some(Self {
            distance: direction.perp(&(origin - first)),
            direction,
        })
    }

    /// The same road, named from its other end where it would else lead against `other`.
    #[must_use]
    pub fn along(self, other: &Self) -> Self {
        if self.direction.dot(&other.direction) >= 0.0 {
            return self;
        }
        Self {
            distance: -self.distance,
            direction: -self.direction,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_is_that_of_equation_48_with_a_side() {
        let (first, last) = (Point2::new(100.0, 0.0), Point2::new(400.0, 400.0));
        let origin = Point2::new(320.0, 240.0);
        let road = StraightRoad::of(first, last, origin).unwrap();
        assert!((road.direction - Vector2::new(0.6, 0.8)).norm() < 1e-12);
        // (p - L1) - [(p - L1) · n] n with p - L1 = (220, 240), along 324: (25.6, -19.2).
        let across: Vector2<f64> = (origin - first) - road.direction * 324.0;
        assert!((across - Vector2::new(25.6, -19.2)).norm() < 1e-9);
        assert!((road.distance + across.norm()).abs() < 1e-9);
        assert_eq!(StraightRoad::of(first, first, origin), None);
    }

    #[test]
    fn a_road_named_from_its_other_end_is_the_same_road() {
        let ends = [Point2::new(10.0, 20.0), Point2::new(90.0, 50.0)];
        let origin = Point2::new(40.0, 70.0);
        let there = StraightRoad::of(ends[0], ends[1], origin).unwrap();
        let back = StraightRoad::of(ends[1], ends[0], origin).unwrap();
        assert!((back.along(&there).distance - there.distance).abs() < 1e-9);
        assert!((back.along(&there).direction - there.direction).norm() < 1e-12);
        assert_eq!(there.along(&there), there);
    }
}
