//! A view made ready for being compared with many places.

use nalgebra::Vector2;
use pilotage_base::frames::{GroundPoint, GroundRect};

use super::field::{DirectionField, REACH};
use super::view::{RoadView, ViewCrossing, ViewPoint};

/// Distance between the points that are compared, metres: nearer ones err alike.
const SPACING: f64 = 8.0;
/// Most points that are compared.
const MOST: usize = 260;
/// Points of the first, rough look at a place.
const FIRST_LOOK: usize = 32;
/// Points of the second look.
const SECOND_LOOK: usize = 72;
/// Half the length of road that a point stands for, metres.
const HALF_PIECE: f64 = 5.0;
/// Side of a cell of the view's own field, metres.
const CELL: f64 = 4.0;
/// Distance within which crossings that were seen are one, metres.
const MERGED: f64 = 12.0;
/// Most crossings that are paired.
const CROSSINGS: usize = 40;

/// View with its points thinned and shuffled, and its own field of distances.
pub(super) struct PreparedView {
    /// Points, so shuffled that the first few are spread over all.
    pub points: Vec<ViewPoint>,
    pub crossings: Vec<ViewCrossing>,
    /// Distances from places of the view (ahead as north, right as east) to what was seen.
    pub field: DirectionField,
}

/// A place of a view as a point of a frame whose north is ahead.
pub(super) fn as_ground(place: Vector2<f64>) -> GroundPoint {
    GroundPoint::from(place)
}

impl PreparedView {
    pub fn new(view: &RoadView) -> Self {
        let mut points = view.thinned(SPACING);
        // Steps of the golden ratio visit all of a list evenly, however many of them are taken.
        let count = points.len();
        let mut order: Vec<(u64, usize)> = (0..count)
            .map(|i| ((i as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15), i))
            .collect();
        order.sort_unstable();
        points.sort_by(|a, b| {
            a.place
                .x
                .total_cmp(&b.place.x)
                .then(a.place.y.total_cmp(&b.place.y))
        });
        let mut points: Vec<ViewPoint> = order.iter().map(|(_, i)| points[*i]).collect();
        points.truncate(MOST);
        let outline = view.outline.iter().map(|c| as_ground(*c));
        let bounds = GroundRect::around(outline)
            .unwrap_or_else(|| GroundRect::centered(GroundPoint::default(), 1.0, 1.0))
            .grown(REACH);
        let pieces = view.points.iter().map(|point| {
            let (sin, cos) = point.direction.sin_cos();
            let half = HALF_PIECE * Vector2::new(cos, sin);
            [as_ground(point.place - half), as_ground(point.place + half)]
        });
        let field = DirectionField::new(&bounds, CELL, pieces);
        let mut crossings: Vec<ViewCrossing> = Vec::new();
        for crossing in &view.crossings {
            let near = |other: &ViewCrossing| (other.place - crossing.place).norm() < MERGED;
            if crossing.directions.len() > 2 && !crossings.iter().any(near) {
                crossings.push(crossing.clone());
            }
            if crossings.len() == CROSSINGS {
                break;
            }
        }
        Self {
            points,
            crossings,
            field,
        }
    }

    /// Points of the first look at a place.
    pub fn first_look(&self) -> &[ViewPoint] {
        &self.points[..self.points.len().min(FIRST_LOOK)]
    }

    /// Points of the second look.
    pub fn second_look(&self) -> &[ViewPoint] {
        &self.points[..self.points.len().min(SECOND_LOOK)]
    }
}
