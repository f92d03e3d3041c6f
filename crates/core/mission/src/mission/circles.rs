//! The way over circles at a way-point: onto the circle and off it along its tangents.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use pilotage_base::frames::GroundPoint;

/// Turn between two pieces of a circle, radians, that a way over points makes of it.
const STEP: f64 = TAU / 8.0;

/// Corners of a way that circles `turns` times around `at`, with arcs at the corners that touch the circle: from
/// `before`, on to `after` if it goes on. The radius is in metres, negative for circles to the left. The number of
/// circles is that with which it leaves towards `after`, at most half of one more or less; `None` where both are too near.
///
/// ```
/// use pilotage_base::frames::GroundPoint;
/// use pilotage_mission::mission::circles;
///
/// let [before, at, after] = [-900.0, 0.0, 900.0].map(|north| GroundPoint::new(north, 0.0));
/// let way = circles(&before, &at, Some(&after), 80.0, 2.0).ok_or("too near")?;
/// // All pieces but the ends touch the circle from outside; the way between them is about two circles long.
/// assert!(way.iter().all(|corner| (80.0..90.0).contains(&corner.distance(&at))));
/// # Ok::<(), &str>(())
/// ```
pub fn circles(
    before: &GroundPoint,
    at: &GroundPoint,
    after: Option<&GroundPoint>,
    radius: f64,
    turns: f64,
) -> Option<Vec<GroundPoint>> {
    let (side, radius) = (radius.signum(), radius.abs());
    // Bearing from the middle of the place at which a tangent from a point touches the circle.
    let tangent = |point: &GroundPoint, sign: f64| {
        let way = point.to_vector() - at.to_vector();
        let distance = way.norm();
        (distance > radius).then(|| way.y.atan2(way.x) + sign * side * (radius / distance).acos())
    };
    let enters = tangent(before, 1.0)?;
    let sweep = match after {
        Some(after) => {
            let part = (side * (tangent(after, -1.0)? - enters)).rem_euclid(TAU);
            part + TAU * (turns - part / TAU).round().max(0.0)
        }
        None => TAU * turns,
    };
    let count = (sweep / STEP).round().max(1.0);
    let step = sweep / count;
    let out = radius / (0.5 * step).cos();
    let corner = |i: usize| {
        let bearing = enters + side * step * (i as f64 + 0.5);
        let arm = out * Vector2::new(bearing.cos(), bearing.sin());
        GroundPoint::new(at.north + arm.x, at.east + arm.y)
    };
    Some((0..count as usize).map(corner).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(north: f64, east: f64) -> GroundPoint {
        GroundPoint::new(north, east)
    }

    fn length(way: &[GroundPoint]) -> f64 {
        way.windows(2).map(|pair| pair[0].distance(&pair[1])).sum()
    }

    #[test]
    fn the_way_goes_on_and_off_the_circle_along_tangents() {
        let (before, at, after) = (p(-1000.0, 50.0), p(0.0, 0.0), p(400.0, 900.0));
        for radius in [80.0, -80.0] {
            let way = circles(&before, &at, Some(&after), radius, 1.0).unwrap();
            for (outside, corner) in [(before, way[0]), (after, *way.last().unwrap())] {
                let along = (corner.to_vector() - outside.to_vector()).normalize();
                let off = along.perp(&(at.to_vector() - outside.to_vector())).abs();
                assert!((off - 80.0).abs() < 1e-9, "{off} m beside the middle");
            }
            // To the right the middle is on the right.
            let first = way[1].to_vector() - way[0].to_vector();
            let turn = first.perp(&(at.to_vector() - way[0].to_vector()));
            assert_eq!(turn.signum(), radius.signum());
        }
    }

    #[test]
    fn circles_are_counted_and_what_lies_inside_is_none() {
        let (before, at) = (p(-1000.0, 0.0), p(0.0, 0.0));
        for turns in [1.0, 3.0, 10.0] {
            let after = p(1000.0, 0.0);
            let way = circles(&before, &at, Some(&after), 80.0, turns).unwrap();
            let flown = length(&way) / (TAU * 80.0);
            assert!((flown - turns).abs() < 0.1 * turns + 0.5, "{flown}");
            let alone = circles(&before, &at, None, 80.0, turns).unwrap();
            assert_eq!(alone.len() as f64, 8.0 * turns);
        }
        assert_eq!(circles(&p(10.0, 0.0), &at, None, 80.0, 1.0), None);
    }
}
