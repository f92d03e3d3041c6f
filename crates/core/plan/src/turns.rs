//! Turns between straight legs: the room that they need, and the path over them.

use std::f64::consts::PI;

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use pilotage_base::frames::GroundPoint;
use pilotage_mission::mission::turn::turn_radius;
use pilotage_simulate::simulate::GuidanceSettings;

/// Sharpest turn that is anticipated before a way-point, radians; as in the guidance.
const SHARPEST: f64 = 2.4;

/// Turn that counts as none, radians.
const STRAIGHT: f64 = 1e-3;
/// Longest piece of an arc that is taken for straight, radians.
const CHORD: f64 = 0.4;

/// Turn of the aircraft from one leg onto the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Turns {
    /// Radius, metres.
    pub radius: f64,
    /// Way over the ground while it rolls into the turn, metres.
    pub roll_in: f64,
}

impl Turns {
    /// Turns at a speed over the ground, m/s, of an aircraft that banks up to `bank`, radians.
    ///
    /// ```
    /// use pilotage_plan::{Turns, planned_aircraft};
    ///
    /// let bank = planned_aircraft().bank_limit;
    /// let (slow, fast) = (Turns::of_flight(15.0, bank), Turns::of_flight(30.0, bank));
    /// // The radius grows with the square of the speed, the way to roll in with the speed.
    /// assert!((fast.radius / slow.radius - 4.0).abs() < 1e-9);
    /// assert!((fast.roll_in / slow.roll_in - 2.0).abs() < 1e-9);
    /// ```
    pub fn of_flight(speed: f64, bank: f64) -> Self {
        let guidance = GuidanceSettings::within(bank);
        Self {
            radius: turn_radius(speed, guidance.planned_bank),
            roll_in: speed * guidance.roll_in,
        }
    }

    /// Way before and behind a way-point that the turn there needs, metres.
    ///
    /// ```
    /// use pilotage_base::frames::GroundPoint;
    /// use pilotage_plan::Turns;
    ///
    /// // For a right angle the arc begins a radius before the corner, and rolling in takes 10 m more.
    /// let turns = Turns { radius: 65.0, roll_in: 10.0 };
    /// let corner = [(0.0, 0.0), (500.0, 0.0), (500.0, 500.0)];
    /// let [before, at, after] = corner.map(|(north, east)| GroundPoint::new(north, east));
    /// assert!((turns.lead(&before, &at, &after) - 75.0).abs() < 1e-9);
    /// ```
    pub fn lead(&self, before: &GroundPoint, at: &GroundPoint, after: &GroundPoint) -> f64 {
        let turn = turn(before, at, after);
        if turn.abs() < STRAIGHT {
            return 0.0;
        }
        self.radius * half_tangent(turn) + self.roll_in
    }

    /// Distance by which the path of [`flown`] passes inside of a way-point where it turns by `turn` radians, metres.
    pub(super) fn cut(&self, turn: f64) -> f64 {
        let turn = turn.abs().min(SHARPEST);
        let chord = turn / chords(turn) as f64;
        self.radius * (1.0 / (0.5 * turn).cos() - (0.5 * chord).cos())
    }

    /// Distance from a way-point within which all turns there are flown, metres.
    pub(super) fn reach(&self) -> f64 {
        self.radius * (half_tangent(PI) + 2.0)
    }
}

/// Turn at `at` between two others, radians, positive to the right.
fn turn(before: &GroundPoint, at: &GroundPoint, after: &GroundPoint) -> f64 {
    let (a, b) = (
        at.to_vector() - before.to_vector(),
        after.to_vector() - at.to_vector(),
    );
    a.perp(&b).atan2(a.dot(&b))
}

/// Distance before a way-point at which the arc of a turn begins, in radii.
fn half_tangent(turn: f64) -> f64 {
    (0.5 * turn.abs().min(SHARPEST)).tan()
}

/// Straight pieces by which an arc of so many radians is followed.
fn chords(turn: f64) -> usize {
    (turn.abs() / CHORD).ceil().max(1.0) as usize
}

/// Index of the first leg that is too short for the turns at its ends; `None` if all fit.
///
/// ```
/// use pilotage_base::frames::GroundPoint;
/// use pilotage_plan::{Turns, fits};
///
/// // Between two right angles a leg needs twice 65 m + 10 m.
/// let turns = Turns { radius: 65.0, roll_in: 10.0 };
/// let line = |leg| [(0., 0.), (500., 0.), (500., leg), (0., leg)].map(|(n, e)| GroundPoint::new(n, e));
/// assert_eq!(fits(&line(151.0), &turns), None);
/// assert_eq!(fits(&line(149.0), &turns), Some(1));
/// ```
pub fn fits(way_points: &[GroundPoint], turns: &Turns) -> Option<usize> {
    let lead = |i: usize| {
        if i == 0 || i + 1 >= way_points.len() {
            0.0
        } else {
            turns.lead(&way_points[i - 1], &way_points[i], &way_points[i + 1])
        }
    };
    (0..way_points.len().saturating_sub(1))
        .find(|&i| way_points[i].distance(&way_points[i + 1]) < lead(i) + lead(i + 1))
}

/// The path over `way_points`: straight, and before each of them an arc onto the next leg that leaves it
/// aside. Where legs are short the arcs are narrower than the aircraft flies.
pub(super) fn flown(way_points: &[GroundPoint], turns: &Turns) -> Vec<GroundPoint> {
    let mut path: Vec<GroundPoint> = way_points.first().copied().into_iter().collect();
    for corner in way_points.windows(3) {
        let at = corner[1].to_vector();
        let before = at - corner[0].to_vector();
        let shorter = before.norm().min(corner[1].distance(&corner[2]));
        let turn = turn(&corner[0], &corner[1], &corner[2]);
        let half = half_tangent(turn);
        let lead = (turns.radius * half).min(0.5 * shorter);
        if turn.abs() < STRAIGHT || lead < 1e-3 {
            path.push(corner[1]);
            continue;
        }
        let (along, side) = (before.normalize(), turn.signum());
        let inwards = side * Vector2::new(-along.y, along.x);
        let (begin, radius) = (at - lead * along, lead / half);
        let chords = chords(turn);
        path.extend((0..=chords).map(|i| {
            let angle = turn.abs() * i as f64 / chords as f64;
            let on_arc = angle.sin() * along + (1.0 - angle.cos()) * inwards;
            GroundPoint::from(begin + radius * on_arc)
        }));
    }
    path.extend(way_points.get(1..).and_then(<[_]>::last));
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    const TURNS: Turns = Turns {
        radius: 65.0,
        roll_in: 10.0,
    };

    fn line(points: &[(f64, f64)]) -> Vec<GroundPoint> {
        points
            .iter()
            .map(|(n, e)| GroundPoint::new(*n, *e))
            .collect()
    }

    #[test]
    fn a_corner_is_cut_by_an_arc_of_the_radius_that_touches_both_legs() {
        let turns = Turns {
            radius: 100.0,
            roll_in: 0.0,
        };
        let line =
            [(0.0, 0.0), (1000.0, 0.0), (1000.0, 800.0)].map(|(n, e)| GroundPoint::new(n, e));
        let path = flown(&line, &turns);
        assert_eq!((path[0], path[path.len() - 1]), (line[0], line[2]));
        let middle = GroundPoint::new(900.0, 100.0);
        for point in &path[1..path.len() - 1] {
            assert!((point.distance(&middle) - 100.0).abs() < 1e-6, "{point:?}");
        }
        assert!(path[1].distance(&GroundPoint::new(900.0, 0.0)) < 1e-6);
        assert!(path[path.len() - 2].distance(&GroundPoint::new(1000.0, 100.0)) < 1e-6);
        // To the left it is the mirror image.
        let left = line.map(|p| GroundPoint::new(p.north, -p.east));
        let mirrored = flown(&left, &turns).into_iter();
        assert!(
            mirrored
                .zip(&path)
                .all(|(l, r)| l.distance(&GroundPoint::new(r.north, -r.east)) < 1e-6)
        );
        assert_eq!(flown(&line[..2], &turns), line[..2]);
    }

    #[test]
    fn a_leg_between_two_right_angles_needs_two_radii() {
        let long = line(&[(0.0, 0.0), (500.0, 0.0), (500.0, 151.0), (0.0, 151.0)]);
        assert_eq!(fits(&long, &TURNS), None);
        let short = line(&[(0.0, 0.0), (500.0, 0.0), (500.0, 149.0), (0.0, 149.0)]);
        assert_eq!(fits(&short, &TURNS), Some(1));
    }

    #[test]
    fn a_way_point_on_a_straight_line_needs_no_room() {
        let straight = line(&[(0.0, 0.0), (5.0, 0.0), (9.0, 0.0)]);
        assert_eq!(fits(&straight, &TURNS), None);
    }
}
