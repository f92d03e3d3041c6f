//! Areas that must not be flown over, and the ways around them.

use std::f64::consts::PI;

use nalgebra::Vector2;

use super::turns::Turns;
use pilotage_base::frames::{GroundPoint, inside};
use pilotage_mission::mission::NoFlyZone;

/// Most that a way-point around a sharp corner is put off it, in clearances.
const SHARPEST: f64 = 3.0;
/// Amount that rounding may take from a clearance, metres.
const ROUNDING: f64 = 1e-6;

/// No-fly areas and the distance that is kept from them, metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Obstacles<'a> {
    pub areas: &'a [NoFlyZone],
    pub clearance: f64,
}

impl Obstacles<'_> {
    /// Whether a place lies in an area or too near to one.
    pub fn forbid(&self, place: &GroundPoint) -> bool {
        !self.leave_room(place, -ROUNDING)
    }

    /// Whether the straight way from `a` to `b` keeps clear of every area.
    pub fn leave_free(&self, a: &GroundPoint, b: &GroundPoint) -> bool {
        let least = (self.clearance - ROUNDING).max(0.0);
        let is_clear = |(c, d): (GroundPoint, GroundPoint)| {
            apart(a, b, &c, &d) >= least && !cross(a, b, &c, &d)
        };
        self.areas.iter().all(|area| {
            !is_forbidden(area, a) && !is_forbidden(area, b) && sides(area).all(is_clear)
        })
    }

    /// Whether all places within `reach` metres of one keep clear of every area.
    pub fn leave_room(&self, place: &GroundPoint, reach: f64) -> bool {
        let margin = self.clearance + reach;
        !self.areas.iter().any(|area| is_within(area, place, margin))
    }

    /// Places beside the corners of the areas and their holes from which one can fly along both sides: as near as straight
    /// legs may lead by, and as far off as it takes to turn from one side to the other with `turns`.
    pub fn corners(&self, turns: &Turns) -> Vec<GroundPoint> {
        let mut corners = Vec::new();
        let off = self.clearance.max(0.5);
        for ring in self.areas.iter().flat_map(NoFlyZone::rings) {
            let n = ring.len();
            for i in 0..n {
                let corner = ring[i].to_vector();
                let before = corner - ring[(i + n - 1) % n].to_vector();
                let after = corner - ring[(i + 1) % n].to_vector();
                if before.norm() < 1e-6 || after.norm() < 1e-6 {
                    continue;
                }
                let (before, after) = (before.normalize(), after.normalize());
                let out = before + after;
                if out.norm() < 1e-3 {
                    continue;
                }
                let out = out.normalize();
                // Sine of half the angle between the sides.
                let half = before.perp(&out).abs().max(1.0 / SHARPEST);
                let near = off / half;
                let wide = off + turns.cut(PI - 2.0 * half.min(1.0).asin());
                for distance in std::iter::once(near).chain((wide > near).then_some(wide)) {
                    for side in beside(&out, &before, &after, half) {
                        let place = GroundPoint::from(corner + side * (1.01 * distance));
                        if !self.forbid(&place) {
                            corners.push(place);
                        }
                    }
                }
            }
        }
        corners
    }
}

/// Directions in which to go off a corner: ahead of it, and for a sharp one also beside both sides.
fn beside(
    out: &Vector2<f64>,
    before: &Vector2<f64>,
    after: &Vector2<f64>,
    half: f64,
) -> Vec<Vector2<f64>> {
    if half > 0.5 {
        return vec![*out];
    }
    vec![
        *out,
        (out + 0.5 * before).normalize(),
        (out + 0.5 * after).normalize(),
    ]
}

/// Sides of an area and of its holes.
pub(super) fn sides(area: &NoFlyZone) -> impl Iterator<Item = (GroundPoint, GroundPoint)> + '_ {
    area.rings().flat_map(|ring| {
        let next = ring.iter().cycle().skip(1);
        ring.iter().copied().zip(next.copied())
    })
}

/// Whether a place is in an area and in none of its holes.
pub fn is_forbidden(zone: &NoFlyZone, place: &GroundPoint) -> bool {
    inside(&zone.corners, place) && !zone.holes.iter().any(|hole| inside(hole, place))
}

/// Whether a place is over an area or closer to it than `margin`, metres.
pub(super) fn is_within(zone: &NoFlyZone, place: &GroundPoint, margin: f64) -> bool {
    is_forbidden(zone, place) || sides(zone).any(|(a, b)| distance(place, &a, &b) < margin)
}

/// Distance from a point to a segment, metres.
pub(super) fn distance(p: &GroundPoint, a: &GroundPoint, b: &GroundPoint) -> f64 {
    let way = b.to_vector() - a.to_vector();
    let to = p.to_vector() - a.to_vector();
    let share = (way.dot(&to) / way.norm_squared().max(1e-12)).clamp(0.0, 1.0);
    (to - way * share).norm()
}

/// Least distance between two segments that do not cross, metres.
fn apart(a: &GroundPoint, b: &GroundPoint, c: &GroundPoint, d: &GroundPoint) -> f64 {
    distance(a, c, d)
        .min(distance(b, c, d))
        .min(distance(c, a, b))
        .min(distance(d, a, b))
}

/// Whether two segments cross at inner points of both.
fn cross(a: &GroundPoint, b: &GroundPoint, c: &GroundPoint, d: &GroundPoint) -> bool {
    let side = |p: &GroundPoint, q: &GroundPoint, r: &GroundPoint| {
        (q.north - p.north) * (r.east - p.east) - (q.east - p.east) * (r.north - p.north)
    };
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(north: f64, east: f64) -> GroundPoint {
        GroundPoint::new(north, east)
    }

    fn square() -> NoFlyZone {
        let corners = [(0.0, 0.0), (0.0, 100.0), (100.0, 100.0), (100.0, 0.0)];
        NoFlyZone {
            corners: corners.map(|(n, e)| point(n, e)).to_vec(),
            ..NoFlyZone::default()
        }
    }

    #[test]
    fn a_way_through_or_close_by_an_area_is_not_free_and_one_with_clearance_is() {
        let areas = [square()];
        let obstacles = Obstacles {
            areas: &areas,
            clearance: 20.0,
        };
        assert!(!obstacles.leave_free(&point(-50.0, 50.0), &point(150.0, 50.0)));
        assert!(!obstacles.leave_free(&point(-50.0, 110.0), &point(150.0, 110.0)));
        assert!(obstacles.leave_free(&point(-50.0, 121.0), &point(150.0, 121.0)));
        assert!(!obstacles.leave_free(&point(50.0, 40.0), &point(50.0, 60.0)));
    }

    #[test]
    fn one_can_fly_around_a_square_from_corner_to_corner() {
        let areas = [square()];
        let obstacles = Obstacles {
            areas: &areas,
            clearance: 20.0,
        };
        let corners = obstacles.corners(&Turns::default());
        assert_eq!(corners.len(), 4, "{corners:?}");
        for i in 0..4 {
            assert!(obstacles.leave_free(&corners[i], &corners[(i + 1) % 4]));
            assert!(!obstacles.leave_free(&corners[i], &corners[(i + 2) % 4]));
        }
    }

    #[test]
    fn a_dent_in_an_area_has_no_corner_to_fly_around() {
        let mut dented = square();
        let dent = point(40.0, 50.0);
        dented.corners.insert(1, dent);
        let areas = [dented];
        let obstacles = Obstacles {
            areas: &areas,
            clearance: 5.0,
        };
        let corners = obstacles.corners(&Turns::default());
        assert!(corners.len() >= 4);
        assert!(corners.iter().all(|c| c.distance(&dent) > 30.0));
    }

    #[test]
    fn in_a_hole_one_may_fly_with_the_clearance_and_over_its_edge_not() {
        let hole = [(20.0, 20.0), (20.0, 80.0), (80.0, 80.0), (80.0, 20.0)];
        let areas = [NoFlyZone {
            holes: vec![hole.map(|(n, e)| point(n, e)).to_vec()],
            ..square()
        }];
        let obstacles = Obstacles {
            areas: &areas,
            clearance: 10.0,
        };
        assert!(obstacles.leave_free(&point(31.0, 31.0), &point(69.0, 69.0)));
        assert!(!obstacles.leave_free(&point(31.0, 50.0), &point(75.0, 50.0)));
        assert!(!obstacles.leave_free(&point(50.0, 50.0), &point(50.0, 150.0)));
        assert!(!obstacles.forbid(&point(50.0, 50.0)));
        assert!(obstacles.forbid(&point(50.0, 75.0)));
        assert!(obstacles.forbid(&point(50.0, 10.0)));
    }

    #[test]
    fn what_pokes_into_a_hole_is_flown_around_within_it() {
        let hole = [
            (10.0, 10.0),
            (10.0, 190.0),
            (190.0, 190.0),
            (190.0, 110.0),
            (60.0, 100.0),
            (190.0, 90.0),
            (190.0, 10.0),
        ];
        let outline = [(0.0, 0.0), (0.0, 200.0), (200.0, 200.0), (200.0, 0.0)];
        let areas = [NoFlyZone {
            corners: outline.map(|(n, e)| point(n, e)).to_vec(),
            holes: vec![hole.map(|(n, e)| point(n, e)).to_vec()],
            ..NoFlyZone::default()
        }];
        let obstacles = Obstacles {
            areas: &areas,
            clearance: 5.0,
        };
        let (west, east) = (point(150.0, 50.0), point(150.0, 150.0));
        assert!(!obstacles.leave_free(&west, &east));
        let corners = obstacles.corners(&Turns::default());
        let around = |c: &GroundPoint| {
            c.north < 60.0 && obstacles.leave_free(&west, c) && obstacles.leave_free(c, &east)
        };
        assert!(corners.iter().any(around), "{corners:?}");
    }
}
