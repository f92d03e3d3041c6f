//! No-fly areas that a route leads over, or that its corridor reaches into.

use pilotage_base::frames::GroundPoint;
use pilotage_mission::mission::NoFlyZone;

use super::corridor::Corridor;
use super::no_fly::{distance, is_forbidden, sides};
use super::prediction::PredictionSample;

/// Part of a route that leads over a no-fly area.
#[derive(Clone, Debug, PartialEq)]
pub struct Incursion {
    /// Number of the area.
    pub zone: usize,
    /// Number of the leg, counted from 0.
    pub leg: usize,
    /// Parts of the leg over the area, from begin to end.
    pub parts: Vec<[GroundPoint; 2]>,
}

impl Incursion {
    /// Length over the area, metres.
    pub fn length(&self) -> f64 {
        self.parts.iter().map(|[a, b]| a.distance(b)).sum()
    }

    /// Warning about it, with the name of the area; `distance` writes metres in the reader's units.
    pub fn sentence(&self, zone: &str, distance: &dyn Fn(f64) -> String) -> String {
        let (leg, length) = (self.leg + 1, distance(self.length()));
        format!("Leg {leg} crosses {zone} for {length}.")
    }
}

/// Stretch of a predicted path on which the aircraft may be over a no-fly area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReachedZone {
    /// Number of the area.
    pub zone: usize,
    /// Distances along the flown path between which the corridor reaches into it, metres.
    pub between: (f64, f64),
}

impl ReachedZone {
    /// Warning about it, with the name of the area; `distance` writes metres in the reader's units.
    pub fn sentence(&self, zone: &str, distance: &dyn Fn(f64) -> String) -> String {
        let [from, to] = [self.between.0, self.between.1].map(distance);
        format!("The 95 % corridor reaches into {zone} from {from} to {to} of the way.")
    }
}

/// Parts of the straight legs between `places` that lie over `zones`, in the order of the legs.
///
/// ```
/// use pilotage_base::frames::GroundPoint;
/// use pilotage_mission::mission::NoFlyZone;
/// use pilotage_plan::incursions;
///
/// let corners = [(0.0, 0.0), (0.0, 100.0), (100.0, 100.0), (100.0, 0.0)];
/// let zone = NoFlyZone {
///     corners: corners.map(|(n, e)| GroundPoint::new(n, e)).to_vec(),
///     ..NoFlyZone::default()
/// };
/// let line = [GroundPoint::new(50.0, -50.0), GroundPoint::new(50.0, 150.0)];
/// let found = incursions(&line, &[zone]);
/// assert!((found[0].length() - 100.0).abs() < 1e-9);
/// ```
pub fn incursions(places: &[GroundPoint], zones: &[NoFlyZone]) -> Vec<Incursion> {
    let mut found = Vec::new();
    for (leg, ends) in places.windows(2).enumerate() {
        for (zone, of) in zones.iter().enumerate() {
            let parts = parts_over(&ends[0], &ends[1], of);
            if !parts.is_empty() {
                found.push(Incursion { zone, leg, parts });
            }
        }
    }
    found
}

/// Parts of a segment over an area: between the places where it crosses an edge, it is over it or not.
fn parts_over(a: &GroundPoint, b: &GroundPoint, zone: &NoFlyZone) -> Vec<[GroundPoint; 2]> {
    let way = b.to_vector() - a.to_vector();
    let at = |share: f64| GroundPoint::from(a.to_vector() + way * share);
    let mut cuts = vec![0.0, 1.0];
    for (c, d) in sides(zone) {
        let edge = d.to_vector() - c.to_vector();
        let turn = way.perp(&edge);
        let to = c.to_vector() - a.to_vector();
        let (share, along) = (to.perp(&edge) / turn, to.perp(&way) / turn);
        if (0.0..=1.0).contains(&share) && (0.0..=1.0).contains(&along) {
            cuts.push(share);
        }
    }
    cuts.sort_by(f64::total_cmp);
    let mut parts: Vec<[GroundPoint; 2]> = Vec::new();
    for pair in cuts.windows(2) {
        let is_over = pair[1] > pair[0]
            && way.norm() > 0.0
            && is_forbidden(zone, &at(0.5 * (pair[0] + pair[1])));
        if !is_over {
            continue;
        }
        let (begin, end) = (at(pair[0]), at(pair[1]));
        match parts.last_mut() {
            Some(last) if last[1].distance(&begin) < 1e-9 => last[1] = end,
            _ => parts.push([begin, end]),
        }
    }
    parts
}

/// Stretches on which the corridor of a predicted path reaches into `zones`.
pub fn reached_zones(samples: &[PredictionSample], zones: &[NoFlyZone]) -> Vec<ReachedZone> {
    let mut found: Vec<ReachedZone> = Vec::new();
    for (zone, of) in zones.iter().enumerate() {
        let mut is_open = false;
        for sample in samples {
            let is_reached = reaches(sample, of);
            let here = sample.distance;
            match found.last_mut() {
                Some(last) if is_reached && is_open => last.between.1 = here,
                _ if is_reached => found.push(ReachedZone {
                    zone,
                    between: (here, here),
                }),
                _ => {}
            }
            is_open = is_reached;
        }
    }
    found
}

/// Whether the ellipse whose half axes along and across the course are those of the corridor reaches into an area.
fn reaches(sample: &PredictionSample, zone: &NoFlyZone) -> bool {
    let Corridor { along, across, .. } = sample.corridor;
    let (sin, cos) = sample.course.sin_cos();
    let squeezed = across / along.max(1e-9);
    // In the frame of the course, with the axis along it made as long as that across, it is a circle.
    let seen = |p: GroundPoint| {
        let off = p.to_vector() - sample.position.to_vector();
        GroundPoint::new(
            squeezed * (cos * off.x + sin * off.y),
            cos * off.y - sin * off.x,
        )
    };
    let here = GroundPoint::new(0.0, 0.0);
    is_forbidden(zone, &sample.position)
        || sides(zone).any(|(a, b)| distance(&here, &seen(a), &seen(b)) < across)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::no_fly::is_within;

    fn ring(corners: &[(f64, f64)]) -> Vec<GroundPoint> {
        let place = |(n, e): &(f64, f64)| GroundPoint::new(*n, *e);
        corners.iter().map(place).collect()
    }

    /// A square of 100 m with a hole of 20 m in its middle.
    fn square() -> NoFlyZone {
        NoFlyZone {
            corners: ring(&[(0.0, 0.0), (0.0, 100.0), (100.0, 100.0), (100.0, 0.0)]),
            holes: vec![ring(&[
                (40.0, 40.0),
                (40.0, 60.0),
                (60.0, 60.0),
                (60.0, 40.0),
            ])],
            ..NoFlyZone::default()
        }
    }

    #[test]
    fn a_route_is_told_by_leg_area_and_length_and_may_fly_in_holes() {
        let zones = [square()];
        let through = ring(&[(50.0, -30.0), (50.0, 130.0), (90.0, 130.0), (90.0, 50.0)]);
        let found = incursions(&through, &zones);
        let told: Vec<_> = found.iter().map(|i| (i.leg, i.parts.len())).collect();
        assert_eq!(told, [(0, 2), (2, 1)]);
        assert!((found[0].length() - 80.0).abs() < 1e-9);
        assert!((found[1].length() - 50.0).abs() < 1e-9);
        let inside = ring(&[(45.0, 45.0), (55.0, 55.0)]);
        assert!(incursions(&inside, &zones).is_empty(), "in the hole");
        let beside = ring(&[(-1.0, -30.0), (-1.0, 130.0)]);
        assert!(incursions(&beside, &zones).is_empty());
    }

    /// A corridor of 300 m along the course and 10 m across at a place.
    fn long_corridor(position: GroundPoint, course: f64) -> PredictionSample {
        PredictionSample {
            time: 0.0,
            distance: 500.0,
            position,
            course,
            corridor: Corridor {
                covariance: nalgebra::Matrix2::identity(),
                sigma_major: 150.0,
                sigma_minor: 5.0,
                heading_of_major: course,
                scale: 2.0,
                across: 10.0,
                along: 300.0,
            },
            detection: Vec::new(),
            dead_reckoning: 0.0,
        }
    }

    #[test]
    fn a_corridor_reaches_as_far_ahead_as_the_place_along_the_course_is_uncertain() {
        let zones = [square()];
        let reached = |north, east, course: f64| {
            let sample = long_corridor(GroundPoint::new(north, east), course.to_radians());
            reached_zones(&[sample], &zones).len()
        };
        // Fifty metres ahead of the last way-point, and 290 and 310 m.
        assert_eq!(reached(50.0, -50.0, 90.0), 1);
        assert_eq!(reached(50.0, -290.0, 90.0), 1);
        assert_eq!(reached(50.0, -310.0, 90.0), 0);
        // Beside it the strip of 10 m counts.
        assert_eq!(reached(50.0, -9.0, 0.0), 1);
        assert_eq!(reached(50.0, -11.0, 0.0), 0);
    }

    #[test]
    fn a_leg_along_an_edge_or_wholly_within_is_no_less_over_it() {
        let zones = [square()];
        let within = ring(&[(10.0, 10.0), (10.0, 90.0)]);
        assert!((incursions(&within, &zones)[0].length() - 80.0).abs() < 1e-9);
        let corner_to_corner = ring(&[(-10.0, -10.0), (110.0, 110.0)]);
        let found = incursions(&corner_to_corner, &zones);
        let diagonal = 2.0_f64.sqrt() * 80.0;
        assert!((found[0].length() - diagonal).abs() < 1e-6, "{found:?}");
        assert!(incursions(&ring(&[(5.0, 5.0), (5.0, 5.0)]), &zones).is_empty());
    }

    #[test]
    fn the_margin_counts_from_every_edge() {
        let zone = square();
        let near = GroundPoint::new(50.0, 108.0);
        assert!(!is_within(&zone, &near, 7.9) && is_within(&zone, &near, 8.1));
        let in_hole = GroundPoint::new(50.0, 50.0);
        assert!(!is_within(&zone, &in_hole, 9.9) && is_within(&zone, &in_hole, 10.1));
        assert!(is_within(&zone, &GroundPoint::new(20.0, 20.0), 0.0));
    }
}
