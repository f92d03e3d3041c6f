//! The legs of a route: distance, course and time in the wind.

use nalgebra::Vector2;
use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::{Route, WayPoint, WayPointAction};
use pilotage_core::plan::circles_at;
use pilotage_core::simulate::Wind;

/// The way from one way-point to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// Metres.
    pub distance: f64,
    /// Course over the ground, radians clockwise from north; `None` without a distance.
    pub course: Option<f64>,
    /// Seconds, with the circles at its end; `None` where the wind is too strong for the airspeed.
    pub time: Option<f64>,
}

/// The legs of `route` for an aircraft that cruises at a speed, m/s, and banks up to an angle, radians, and last the way
/// back, if there is one.
pub fn legs(
    route: &Route,
    way_back: Option<[GroundPoint; 2]>,
    (cruise, bank): (f64, f64),
    wind: &Wind,
) -> Vec<Leg> {
    let air = wind.velocity();
    let leg = |[from, to]: [GroundPoint; 2], airspeed: f64, stays: f64| {
        let way = to.to_vector() - from.to_vector();
        let distance = way.norm();
        if distance < 1e-6 {
            return Leg {
                distance: 0.0,
                course: None,
                time: Some(stays),
            };
        }
        let along = way / distance;
        let speed = ground_speed(airspeed, &along, &air);
        Leg {
            distance,
            course: Some(along.y.atan2(along.x).rem_euclid(std::f64::consts::TAU)),
            time: speed.map(|speed| distance / speed + stays),
        }
    };
    let between = route.way_points.windows(2).map(|pair| {
        let ends = [pair[0].position, pair[1].position];
        leg(
            ends,
            pair[1].speed.unwrap_or(cruise),
            circles(&pair[1], (cruise, bank)),
        )
    });
    let back = way_back.map(|ends| leg(ends, cruise, 0.0));
    between.chain(back).collect()
}

/// Seconds that circles at a way-point take, through the air, as wide as they are flown.
fn circles(at: &WayPoint, (cruise, bank): (f64, f64)) -> f64 {
    match at.action {
        WayPointAction::Loiter { .. } => circles_at(at, bank).map_or(0.0, |(radius, turns)| {
            let way = std::f64::consts::TAU * radius.abs() * turns.max(0.0);
            way / at.speed.unwrap_or(cruise).max(1.0)
        }),
        WayPointAction::Wait { seconds, .. } => seconds.unwrap_or(0.0).max(0.0),
        _ => 0.0,
    }
}

/// Speed over the ground on a course in a wind: what is left of the airspeed after holding against
/// the wind across, plus the wind along. `None` if it does not get on.
fn ground_speed(airspeed: f64, along: &Vector2<f64>, wind: &Vector2<f64>) -> Option<f64> {
    let tail = wind.dot(along);
    let across = wind - along * tail;
    let left = airspeed * airspeed - across.norm_squared();
    let speed = left.max(0.0).sqrt() + tail;
    (left > 0.0 && speed > 0.1).then_some(speed)
}

/// Length, metres, and time, seconds, of all legs.
pub fn totals(legs: &[Leg]) -> (f64, Option<f64>) {
    let time = legs.iter().map(|l| l.time).sum::<Option<f64>>();
    (legs.iter().map(|l| l.distance).sum(), time)
}

/// Minutes and seconds.
pub fn time_text(seconds: Option<f64>) -> String {
    seconds.map_or_else(
        || "no way".to_owned(),
        |s| format!("{}:{:02}", s.round() as u64 / 60, s.round() as u64 % 60),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::frames::{Altitude, AltitudeFrame};

    /// Cruise, m/s, and greatest bank, radians.
    const AIRCRAFT: (f64, f64) = (20.0, 0.55);

    fn east() -> Route {
        let altitude = Altitude::new(100.0, AltitudeFrame::AboveGround);
        let at = |e| WayPoint::new(GroundPoint::new(0.0, e), altitude);
        Route {
            way_points: vec![at(0.0), at(600.0)],
            ..Route::default()
        }
    }

    #[test]
    fn a_head_wind_lengthens_the_time_and_a_cross_wind_a_little() {
        let from = |degrees: f64, speed| Wind {
            from: degrees.to_radians(),
            speed,
        };
        let time = |wind| legs(&east(), None, AIRCRAFT, &wind)[0].time;
        assert_eq!(time(Wind::default()), Some(30.0));
        assert!((time(from(90.0, 5.0)).unwrap() - 40.0).abs() < 1e-9);
        assert!((time(from(0.0, 12.0)).unwrap() - 37.5).abs() < 1e-9);
        assert_eq!(time(from(90.0, 20.0)), None);
        assert_eq!(time_text(Some(97.6)), "1:38");
    }

    #[test]
    fn circles_at_the_end_of_a_leg_take_their_time() {
        let mut route = east();
        route.way_points[1].action = WayPointAction::Loiter {
            radius: -100.0,
            turns: 2.0,
        };
        let time = legs(&route, None, AIRCRAFT, &Wind::default())[0]
            .time
            .unwrap();
        assert!(
            (time - 30.0 - 20.0 * std::f64::consts::PI).abs() < 1e-9,
            "{time}"
        );
    }

    #[test]
    fn circles_that_are_tighter_than_the_aircraft_can_fly_take_as_long_as_it_does() {
        let aircraft = pilotage_core::plan::planned_aircraft();
        let mut route = east();
        let mut time = |radius| {
            route.way_points[1].action = WayPointAction::Loiter {
                radius,
                turns: 10.0,
            };
            let flies = (aircraft.cruise, aircraft.bank_limit);
            let leg = legs(&route, None, flies, &Wind::default())[0];
            leg.time.unwrap() - 600.0 / aircraft.cruise
        };
        // Ten circles of v² / (g tan 29°) = 65.5 m at 18.87 m/s; a radius of zero is the autopilot's own.
        for radius in [0.0, 20.0, -20.0] {
            assert!((time(radius) - 218.0).abs() < 1.0, "{}", time(radius));
        }
    }

    #[test]
    fn waiting_at_the_end_of_a_leg_takes_its_time() {
        let mut route = east();
        let wait = |seconds| WayPointAction::Wait {
            radius: 80.0,
            seconds,
        };
        route.way_points[1].action = wait(Some(45.0));
        assert_eq!(
            legs(&route, None, AIRCRAFT, &Wind::default())[0].time,
            Some(75.0)
        );
        route.way_points[1].action = wait(None);
        assert_eq!(
            legs(&route, None, AIRCRAFT, &Wind::default())[0].time,
            Some(30.0)
        );
    }

    #[test]
    fn the_way_back_is_a_leg_in_cruise() {
        let mut route = east();
        route.way_points[1].speed = Some(10.0);
        let back = [GroundPoint::new(0.0, 600.0), GroundPoint::new(0.0, 0.0)];
        let all = legs(&route, Some(back), AIRCRAFT, &Wind::default());
        assert_eq!(totals(&all), (1200.0, Some(90.0)));
        assert!((all[1].course.unwrap().to_degrees() - 270.0).abs() < 1e-9);
    }

    #[test]
    fn the_course_counts_clockwise_from_north() {
        let leg = legs(&east(), None, AIRCRAFT, &Wind::default())[0];
        assert!((leg.course.unwrap().to_degrees() - 90.0).abs() < 1e-9);
    }
}
