//! Roads as one picture shows them, and the pose that lays them on the map.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use nalgebra::Vector2;
use pilotage_base::frames::{GroundPoint, inside, wrap_pi};
use serde::{Deserialize, Serialize};

use crate::course::{between, nearest_share, place_along};
use crate::map::{RoadCrossing, RoadMap};

/// Point on a road around the point below the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewPoint {
    /// Place ahead and to the right of the point below the camera, metres, along the assumed heading and height.
    pub place: Vector2<f64>,
    /// Direction of the road, radians clockwise from ahead; either sense.
    pub direction: f64,
}

/// Place where roads meet around the point below the camera.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewCrossing {
    /// Place ahead and to the right of the point below the camera, metres.
    pub place: Vector2<f64>,
    /// Directions in which roads leave, radians clockwise from ahead.
    pub directions: Vec<f64>,
}

/// Roads that a picture shows, in metres around the point below the camera.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RoadView {
    /// Points along centre lines, in no order.
    pub points: Vec<ViewPoint>,
    /// Places where roads meet, the surest first.
    pub crossings: Vec<ViewCrossing>,
    /// Corners of the ground that was looked at, ahead and to the right, metres: an outline in the order of
    /// either sense.
    pub outline: Vec<Vector2<f64>>,
}

/// Pose of a view on the map: a point q of the view lies at place + scale · R(turn) q.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ViewPose {
    /// Point below the camera.
    pub place: GroundPoint,
    /// Heading of what the view calls ahead, radians clockwise from north, from -π to π.
    pub turn: f64,
    /// Metres of the ground in a metre of the view: true over assumed height.
    pub scale: f64,
}

impl ViewPose {
    /// Place on the map of a place of the view.
    pub fn on_map(&self, place: Vector2<f64>) -> GroundPoint {
        let (sin, cos) = self.turn.sin_cos();
        let turned = Vector2::new(cos * place.x - sin * place.y, sin * place.x + cos * place.y);
        GroundPoint::from(self.place.to_vector() + self.scale * turned)
    }

    /// Place in the view of a place on the map.
    pub fn in_view(&self, point: GroundPoint) -> Vector2<f64> {
        let (sin, cos) = self.turn.sin_cos();
        let from = (point.to_vector() - self.place.to_vector()) / self.scale;
        Vector2::new(cos * from.x + sin * from.y, cos * from.y - sin * from.x)
    }

    /// Pose after a motion from this one.
    #[must_use]
    pub fn after(&self, motion: &ViewMotion) -> Self {
        let unscaled = Self {
            scale: 1.0,
            ..*self
        };
        Self {
            place: unscaled.on_map(motion.way),
            turn: wrap_pi(self.turn + motion.turn),
            scale: self.scale,
        }
    }

    /// Pose from which a motion led to this one.
    #[must_use]
    pub fn before(&self, motion: &ViewMotion) -> Self {
        let turn = wrap_pi(self.turn - motion.turn);
        let back = Self {
            turn,
            scale: 1.0,
            ..*self
        };
        Self {
            place: back.on_map(-motion.way),
            turn,
            scale: self.scale,
        }
    }
}

/// Motion from one view to the next by dead reckoning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewMotion {
    /// Way ahead and to the right, in the frame of the view before, metres.
    pub way: Vector2<f64>,
    /// Turn clockwise, radians.
    pub turn: f64,
    /// Standard deviation of the way, metres per axis.
    pub way_deviation: f64,
    /// Standard deviation of the turn, radians.
    pub turn_deviation: f64,
}

/// Distance between the points of a view that is made of lines, metres.
const SPACING: f64 = 4.0;

impl RoadView {
    /// The view that shows all roads of a map and what lies between them, about the middle of these; `None` without a
    /// road.
    pub fn of_map(map: &RoadMap) -> Option<Self> {
        let bounds = map.bounds()?;
        let middle = bounds.center().to_vector();
        let mut points = Vec::new();
        for edge in map.graph().edge_weights() {
            let mut along = 0.5 * SPACING.min(edge.length);
            while along < edge.length {
                let on_road = place_along(&edge.course, along)?;
                points.push(ViewPoint {
                    place: on_road.point.to_vector() - middle,
                    direction: on_road.heading.rem_euclid(PI),
                });
                along += SPACING;
            }
        }
        let crossing = |crossing: RoadCrossing| ViewCrossing {
            place: crossing.place.to_vector() - middle,
            directions: crossing.directions,
        };
        Some(Self {
            points,
            crossings: map.crossings().into_iter().map(crossing).collect(),
            outline: bounds.corners().map(|c| c.to_vector() - middle).to_vec(),
        })
    }

    /// Points at least `spacing` metres from each other where they run alike.
    pub(super) fn thinned(&self, spacing: f64) -> Vec<ViewPoint> {
        let mut kept: Vec<ViewPoint> = Vec::new();
        let cell = |value: f64| (value / spacing).floor() as i32;
        let mut cells: BTreeMap<(i32, i32), Vec<usize>> = BTreeMap::new();
        for point in &self.points {
            let (x, y) = (cell(point.place.x), cell(point.place.y));
            let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y)));
            let mut near = around.filter_map(|c| cells.get(&c)).flatten();
            let is_known = near.any(|i| {
                let other = &kept[*i];
                let apart = (point.direction - other.direction).sin().abs();
                (other.place - point.place).norm() < spacing && apart < 0.4
            });
            if !is_known {
                cells.entry((x, y)).or_default().push(kept.len());
                kept.push(*point);
            }
        }
        kept
    }

    /// Whether a place of the view lies on the ground that was looked at, `margin` metres within its outline.
    pub(super) fn looked_at(&self, place: Vector2<f64>, margin: f64) -> bool {
        let at = GroundPoint::from(place);
        let next = self.outline.iter().cycle().skip(1);
        let mut sides = self.outline.iter().zip(next);
        inside(&self.outline, &at)
            && sides.all(|(from, to)| {
                let (from, to) = ((*from).into(), (*to).into());
                let foot = between(from, to, nearest_share(from, to, at));
                foot.distance(&at) >= margin
            })
    }

    /// Area of the ground that was looked at, square metres.
    pub(super) fn area(&self) -> f64 {
        let count = self.outline.len();
        let twice: f64 = (0..count)
            .map(|i| self.outline[i].perp(&self.outline[(i + 1) % count]))
            .sum();
        0.5 * twice.abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn what_lies_ahead_of_a_view_to_the_east_lies_east() {
        let pose = ViewPose {
            place: GroundPoint::new(100.0, 50.0),
            turn: FRAC_PI_2,
            scale: 1.1,
        };
        let ahead = pose.on_map(Vector2::new(10.0, 0.0));
        assert!(ahead.distance(&GroundPoint::new(100.0, 61.0)) < 1e-9);
        let right = pose.on_map(Vector2::new(0.0, 10.0));
        assert!(right.distance(&GroundPoint::new(89.0, 50.0)) < 1e-9);
        assert!((pose.in_view(right) - Vector2::new(0.0, 10.0)).norm() < 1e-9);
    }

    #[test]
    fn a_motion_and_its_way_back_end_where_they_began() {
        let pose = ViewPose {
            place: GroundPoint::new(-40.0, 20.0),
            turn: 2.0,
            scale: 0.97,
        };
        let motion = ViewMotion {
            way: Vector2::new(300.0, -40.0),
            turn: 1.8,
            way_deviation: 5.0,
            turn_deviation: 0.02,
        };
        let there = pose.after(&motion);
        assert!((there.place.distance(&pose.place) - motion.way.norm()).abs() < 1e-9);
        let back = there.before(&motion);
        assert!(back.place.distance(&pose.place) < 1e-9);
        assert!((back.turn - pose.turn).abs() < 1e-12);
    }

    #[test]
    fn places_within_the_outline_were_looked_at() {
        let corner = |x, y| Vector2::new(x, y);
        let view = RoadView {
            outline: vec![
                corner(-10.0, -20.0),
                corner(10.0, -20.0),
                corner(10.0, 20.0),
                corner(-10.0, 20.0),
            ],
            ..RoadView::default()
        };
        assert!(view.looked_at(corner(5.0, 15.0), 3.0));
        assert!(!view.looked_at(corner(8.0, 15.0), 3.0));
        assert!(!view.looked_at(corner(15.0, 0.0), 3.0));
        assert_eq!(view.area(), 800.0);
    }

    /// A lens of the barrel kind sees sides that bend inward.
    #[test]
    fn places_were_looked_at_within_an_outline_whose_sides_bend_inward() {
        let corner = |x, y| Vector2::new(x, y);
        let view = RoadView {
            outline: vec![
                corner(-10.0, -20.0),
                corner(-4.0, 0.0),
                corner(-10.0, 20.0),
                corner(10.0, 20.0),
                corner(10.0, -20.0),
            ],
            ..RoadView::default()
        };
        for (x, y) in [(0.0, 0.0), (-6.0, 15.0), (-6.0, -15.0), (6.0, 16.0)] {
            assert!(view.looked_at(corner(x, y), 1.0), "{x} {y}");
        }
        assert!(!view.looked_at(corner(-6.0, 0.0), 1.0));
        assert!(!view.looked_at(corner(-3.0, 0.0), 1.5));
        assert!(!view.looked_at(corner(f64::NAN, 0.0), 1.0));
    }
}
