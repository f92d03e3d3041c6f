//! The turn at a way-point that is flown by.

use nalgebra::Vector2;

use pilotage_base::frames::GroundPoint;
use pilotage_base::frames::units::GRAVITY;

/// An arc that leaves one leg and ends on the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// Middle of the circle.
    pub middle: GroundPoint,
    /// Its radius, metres.
    pub radius: f64,
    /// Point at which it begins.
    pub begin: GroundPoint,
    /// Change of course, radians, positive to the right.
    pub angle: f64,
    /// Distance before the way-point at which it begins, and behind it at which it ends, metres.
    pub lead: f64,
}

/// Radius of a level turn in calm air, metres: r = v² / (g tan φ), for an airspeed `speed`, m/s, and a
/// bank, radians.
///
/// ```
/// use pilotage_mission::mission::turn::turn_radius;
///
/// // 20 m/s at a bank of 45°, whose tangent is 1: v² / g.
/// let radius = turn_radius(20.0, 45_f64.to_radians());
/// assert!((radius - 400.0 / 9.806_65).abs() < 1e-9);
/// ```
pub fn turn_radius(speed: f64, bank: f64) -> f64 {
    speed * speed / (GRAVITY * bank.tan())
}

impl Turn {
    /// The turn at `at` between two legs; `None` where there is none: straight on, or straight back.
    ///
    /// ```
    /// use pilotage_base::frames::GroundPoint;
    /// use pilotage_mission::mission::turn::Turn;
    ///
    /// // From north to east with a radius of 40 m: begins and ends 40 m from the corner.
    /// let corner = [(0.0, 0.0), (100.0, 0.0), (100.0, 100.0)];
    /// let [before, at, after] = corner.map(|(north, east)| GroundPoint::new(north, east));
    /// let turn = Turn::at(&before, &at, &after, 40.0).ok_or("straight on")?;
    /// assert!((turn.angle.to_degrees() - 90.0).abs() < 1e-9);
    /// assert!(turn.begin.distance(&GroundPoint::new(60.0, 0.0)) < 1e-9);
    /// assert!(turn.middle.distance(&GroundPoint::new(60.0, 40.0)) < 1e-9);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn at(
        before: &GroundPoint,
        at: &GroundPoint,
        after: &GroundPoint,
        radius: f64,
    ) -> Option<Self> {
        let way =
            |a: &GroundPoint, b: &GroundPoint| (b.to_vector() - a.to_vector()).try_normalize(1e-9);
        let (into, out) = (way(before, at)?, way(at, after)?);
        // North and east turn clockwise, as courses do.
        let angle = into.perp(&out).atan2(into.dot(&out));
        let lead = radius * (0.5 * angle.abs()).tan();
        if angle.abs() < 0.5_f64.to_radians() || angle.abs() > 175.0_f64.to_radians() {
            return None;
        }
        let begin = at.to_vector() - lead * into;
        let side = Vector2::new(-into.y, into.x) * angle.signum();
        let middle = begin + radius * side;
        Some(Self {
            middle: GroundPoint::new(middle.x, middle.y),
            radius,
            begin: GroundPoint::new(begin.x, begin.y),
            angle,
            lead,
        })
    }

    /// Places along the arc, from its beginning to its end.
    pub fn places(&self) -> Vec<GroundPoint> {
        let parts = (self.angle.abs() / 6.0_f64.to_radians()).ceil().max(2.0) as usize;
        let arm = self.begin.to_vector() - self.middle.to_vector();
        (0..=parts)
            .map(|i| {
                let (sin, cos) = (self.angle * i as f64 / parts as f64).sin_cos();
                GroundPoint::new(
                    self.middle.north + cos * arm.x - sin * arm.y,
                    self.middle.east + sin * arm.x + cos * arm.y,
                )
            })
            .collect()
    }
}

/// Legs of a line that are too short for the turns at their ends with this radius, by the way-point that they
/// lead to.
pub fn too_short(places: &[GroundPoint], radius: f64) -> Vec<usize> {
    let lead = |i: usize| {
        if i == 0 || i + 1 >= places.len() {
            return 0.0;
        }
        Turn::at(&places[i - 1], &places[i], &places[i + 1], radius).map_or(0.0, |t| t.lead)
    };
    (1..places.len())
        .filter(|i| lead(i - 1) + lead(*i) > places[i - 1].distance(&places[*i]) + 1e-9)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(north: f64, east: f64) -> GroundPoint {
        GroundPoint::new(north, east)
    }

    #[test]
    fn a_turn_to_the_right_touches_both_legs() {
        let turn = Turn::at(&p(0.0, 0.0), &p(100.0, 0.0), &p(100.0, 100.0), 40.0).unwrap();
        assert!((turn.angle.to_degrees() - 90.0).abs() < 1e-9);
        assert!((turn.lead - 40.0).abs() < 1e-9);
        let places = turn.places();
        assert!(places[0].distance(&p(60.0, 0.0)) < 1e-9);
        assert!(places.last().unwrap().distance(&p(100.0, 40.0)) < 1e-9);
        assert!(
            places
                .iter()
                .all(|q| (q.distance(&turn.middle) - 40.0).abs() < 1e-9)
        );
    }

    #[test]
    fn a_turn_to_the_left_is_its_mirror() {
        let turn = Turn::at(&p(0.0, 0.0), &p(100.0, 0.0), &p(100.0, -100.0), 40.0).unwrap();
        let end = *turn.places().last().unwrap();
        assert!(end.distance(&p(100.0, -40.0)) < 1e-9, "{end:?}");
    }

    #[test]
    fn a_leg_between_two_turns_must_hold_both() {
        let zigzag = [p(0.0, 0.0), p(200.0, 0.0), p(200.0, 60.0), p(400.0, 60.0)];
        assert_eq!(too_short(&zigzag, 40.0), [2]);
        assert!(too_short(&zigzag, 25.0).is_empty());
    }

    #[test]
    fn twenty_metres_per_second_at_thirty_degrees_turn_in_seventy_metres() {
        assert!((turn_radius(20.0, 30.0_f64.to_radians()) - 70.65).abs() < 0.05);
    }
}
