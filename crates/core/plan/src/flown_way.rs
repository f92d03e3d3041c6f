//! The way that an aircraft flies along a route: over its way-points and the circles there, as high as the ground below
//! lets it, and home where it returns.

use std::f64::consts::TAU;

use pilotage_base::frames::{Altitude, AltitudeFrame, AltitudeReference, GroundPoint, LocalFrame};
use pilotage_mission::mission::turn::turn_radius;
use pilotage_mission::mission::{NoFlyZone, Route, WayPoint, WayPointAction, circles};
use pilotage_simulate::simulate::{Airframe, GuidanceSettings, Target};

use super::incursion::{Incursion, incursions};
use super::profile::{ProfileSample, on_leg, profile};

/// Limits of the pieces in which a leg is predicted where the ground lets the height change otherwise than
/// evenly: from so many metres off on, and none shorter than that many, so that turns have room before they
/// begin.
const UNEVEN: f64 = 4.0;
const SHORTEST_PIECE: f64 = 200.0;
/// Places at which a piece is looked at, at least, and for each of the shortest pieces in it, and at most.
const BENDS: f64 = 20.0;
/// See [`BENDS`].
const LOOKS: f64 = 4.0;
/// See [`BENDS`].
const MOST_BENDS: f64 = 2000.0;

/// Most circles that are predicted at a way-point.
pub const MOST_CIRCLES: f64 = 20.0;

/// Lowest height above ground that is flown, metres.
const LOWEST: f64 = 1.0;

/// Time beyond that of the way itself before a flight that does not get on is broken off, seconds.
const PATIENCE: f64 = 120.0;

/// The aircraft that is planned for.
pub fn planned_aircraft() -> Airframe {
    Airframe::sig_kadet_senior()
}

/// Airspeed in cruise of the aircraft that is planned for, m/s.
pub fn cruise() -> f64 {
    planned_aircraft().cruise
}

/// Longest time of a flight over these places at an airspeed, m/s, before it is broken off because the wind is too strong to
/// get on, seconds.
pub fn longest_flight(places: &[GroundPoint], airspeed: f64) -> f64 {
    let legs = places.windows(2);
    let length: f64 = legs.map(|pair| pair[0].distance(&pair[1])).sum();
    PATIENCE + 4.0 * length / airspeed.max(1.0)
}

/// Ground under a route.
#[derive(Clone, Copy)]
pub struct RouteGround<'a> {
    /// Height of the ground at a place, metres above mean sea level or the datum of an elevation model.
    pub height_at: &'a dyn Fn(&GroundPoint) -> f64,
    /// Height of the place of take-off on the same datum, metres.
    pub take_off: f64,
    /// Whether it is as high everywhere.
    pub is_level: bool,
}

impl<'a> RouteGround<'a> {
    /// Heights on the leg between two way-points, by the share of it that is flown.
    fn leg(&self, from: &'a WayPoint, to: &'a WayPoint) -> impl Fn(f64) -> ProfileSample + 'a {
        on_leg((from, to), self.height_at, self.take_off)
    }

    /// Height of a way-point above the ground below it, metres.
    pub fn above(&self, way_point: &WayPoint) -> f64 {
        let reference = AltitudeReference {
            take_off: self.take_off,
            ground: (self.height_at)(&way_point.position),
        };
        let altitude = &way_point.altitude;
        altitude
            .counted_from(AltitudeFrame::AboveGround, &reference)
            .metres
    }

    /// Mean height of a route above the ground below it, metres; of its first way-point where it has no length, and
    /// `None` without any.
    pub fn mean_above(&self, route: &Route) -> Option<f64> {
        let samples = profile(route, self.height_at, self.take_off, f64::INFINITY);
        let (mut sum, mut length) = (0.0, 0.0);
        for pair in samples.windows(2) {
            let step = pair[1].distance - pair[0].distance;
            sum += step * 0.5 * (pair[0].above() + pair[1].above());
            length += step;
        }
        let first = || route.way_points.first().map(|w| self.above(w));
        let mean = (length > 0.0).then(|| sum / length).or_else(first);
        mean.map(|height| height.max(LOWEST))
    }
}

/// Greatest height of ground, metres above its datum, over which a route at `altitude` keeps `clearance` metres, that
/// takes off from `take_off` on that datum; `None` where it follows the ground high enough to need no limit, and below
/// everything where it follows it too low.
pub fn highest_ground(altitude: Altitude, take_off: f64, clearance: f64) -> Option<f64> {
    let reference = AltitudeReference {
        take_off,
        ground: 0.0,
    };
    match altitude.frame {
        AltitudeFrame::AboveGround if altitude.metres >= clearance => None,
        AltitudeFrame::AboveGround => Some(f64::NEG_INFINITY),
        AltitudeFrame::Amsl | AltitudeFrame::AboveTakeOff => {
            Some(altitude.amsl(&reference) - clearance)
        }
    }
}

/// Home as a way-point at the altitude of the last one, if a route returns there.
pub fn home_way_point(route: &Route, frame: &LocalFrame) -> Option<WayPoint> {
    let [_, home] = route.way_back(frame)?;
    Some(WayPoint::new(home, route.way_points.last()?.altitude))
}

/// Place from whose ground altitudes above take-off are counted: home, where `is_known` says that the ground's height is
/// known there, or else the first way-point; `frame` is the world's.
pub fn take_off_place(
    route: &Route,
    frame: &LocalFrame,
    is_known: impl FnOnce(&GroundPoint) -> bool,
) -> Option<GroundPoint> {
    let first = route.way_points.first().map(|it| it.position);
    route.home(frame).filter(is_known).or(first)
}

/// Radius in metres, negative to the left, and number of the circles at a way-point, as an aircraft flies them that
/// banks up to `bank`, radians; `None` where it flies by. Waiting without an end is flown by as well.
pub fn circles_at(way_point: &WayPoint, bank: f64) -> Option<(f64, f64)> {
    let speed = way_point.speed.unwrap_or_else(cruise);
    let tightest = turn_radius(speed, GuidanceSettings::within(bank).planned_bank);
    let flown = |radius: f64| {
        let side = if radius < 0.0 { -1.0 } else { 1.0 };
        side * radius.abs().max(tightest)
    };
    match way_point.action {
        WayPointAction::Loiter { radius, turns } => Some((flown(radius), turns)),
        WayPointAction::Wait {
            radius,
            seconds: Some(seconds),
        } => {
            let radius = flown(radius);
            Some((radius, seconds * speed / (TAU * radius.abs())))
        }
        _ => None,
    }
}

/// Places over which a route is flown, with what is flown there.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlownWay {
    /// Places on the ground.
    pub places: Vec<GroundPoint>,
    /// Height above ground, metres, and airspeed at each of them.
    pub targets: Vec<Target>,
    /// Number of the way-point to which the way leads there or that it circles, counted from 0.
    pub towards: Vec<usize>,
}

impl FlownWay {
    /// Way along a route in the world of `frame`: its way-points, and between them places from which on the ground lets
    /// the height change otherwise; around way-points the circles that an aircraft flies which banks up to `bank`,
    /// radians; and home, if it returns.
    ///
    /// ```
    /// use pilotage_base::frames::{Altitude, AltitudeFrame, Geodetic, GroundPoint, LocalFrame};
    /// use pilotage_mission::mission::{Route, WayPoint};
    /// use pilotage_plan::{FlownWay, RouteGround};
    ///
    /// // At 520 m above the sea over ground at 400 m.
    /// let altitude = Altitude::new(520.0, AltitudeFrame::Amsl);
    /// let at = |east| WayPoint::new(GroundPoint::new(0.0, east), altitude);
    /// let route = Route { way_points: vec![at(0.0), at(900.0)], ..Route::default() };
    /// let ground = RouteGround { height_at: &|_| 400.0, take_off: 400.0, is_level: true };
    /// let frame = LocalFrame::new(Geodetic::from_degrees(46.0, -92.0, 0.0));
    /// let way = FlownWay::along(&route, &frame, &ground, 0.5);
    /// assert_eq!(way.places.len(), 2);
    /// assert_eq!(way.targets[1].height, 120.0);
    /// ```
    pub fn along(route: &Route, frame: &LocalFrame, ground: &RouteGround<'_>, bank: f64) -> Self {
        let mut way = Self::default();
        let back = home_way_point(route, frame);
        let all: Vec<&WayPoint> = route.way_points.iter().chain(&back).collect();
        for (index, way_point) in all.iter().copied().enumerate() {
            let before = index.checked_sub(1).map(|i| all[i]);
            let leg = ground.leg(before.unwrap_or(way_point), way_point);
            if let Some(before) = before.filter(|_| !ground.is_level) {
                let length = before.position.distance(&way_point.position);
                let mut bends = Vec::new();
                let above = |share: f64| leg(share).above();
                bend(&above, (0.0, 1.0), SHORTEST_PIECE / length, &mut bends);
                for share in bends {
                    way.add(&leg(share), (index, way_point));
                }
            }
            let around = before.and_then(|before| {
                let (radius, turns) = circles_at(way_point, bank)?;
                let after = all.get(index + 1).map(|next| &next.position);
                let turns = turns.min(MOST_CIRCLES);
                circles(&before.position, &way_point.position, after, radius, turns)
            });
            match around {
                Some(around) => {
                    for place in around {
                        let there = WayPoint {
                            position: place,
                            ..way_point.clone()
                        };
                        way.add(&ground.leg(&there, &there)(1.0), (index, way_point));
                    }
                }
                None => way.add(&leg(1.0), (index, way_point)),
            }
        }
        way
    }

    /// Parts of the way over no-fly areas, in the order of the route's legs; the circles around a way-point count to the leg
    /// that leads there.
    pub fn incursions(&self, zones: &[NoFlyZone]) -> Vec<Incursion> {
        let mut found: Vec<Incursion> = Vec::new();
        for piece in incursions(&self.places, zones) {
            let leg = self.towards[piece.leg + 1].saturating_sub(1);
            let is_same = |it: &&mut Incursion| (it.leg, it.zone) == (leg, piece.zone);
            match found.iter_mut().find(is_same) {
                Some(known) => known.parts.extend(piece.parts),
                None => found.push(Incursion { leg, ..piece }),
            }
        }
        found
    }

    fn add(&mut self, sample: &ProfileSample, (number, towards): (usize, &WayPoint)) {
        self.places.push(sample.place);
        self.towards.push(number);
        self.targets.push(Target {
            height: sample.above().max(LOWEST),
            airspeed: towards.speed,
        });
    }
}

/// Shares of a leg between `a` and `b` at which its height above ground stops to change evenly, no two
/// closer than `least`.
fn bend(above: &dyn Fn(f64) -> f64, (a, b): (f64, f64), least: f64, bends: &mut Vec<f64>) {
    let (from, to) = (above(a), above(b));
    let off = |s: f64| (above(s) - from - (s - a) / (b - a) * (to - from)).abs();
    let looks = (LOOKS * (b - a) / least).clamp(BENDS, MOST_BENDS).ceil();
    let inner = (1..looks as u32).map(|i| a + (b - a) * f64::from(i) / looks);
    let worst = inner
        .filter(|s| s - a >= least && b - s >= least)
        .map(|s| (s, off(s)))
        .max_by(|x, y| x.1.total_cmp(&y.1));
    if let Some((at, _)) = worst.filter(|(_, off)| *off > UNEVEN) {
        bend(above, (a, at), least, bends);
        bends.push(at);
        bend(above, (at, b), least, bends);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_base::frames::Geodetic;

    #[test]
    fn a_ridge_on_a_long_leg_is_flown_over_as_low_as_it_is() {
        // 40 km with a ridge 1 km wide between two of twenty places, 80 of 120 m high.
        let ridge = |p: &GroundPoint| 80.0 * (1.0 - ((p.east - 21_000.0) / 500.0).abs()).max(0.0);
        let at = |east| {
            let altitude = Altitude::new(120.0, AltitudeFrame::Amsl);
            WayPoint::new(GroundPoint::new(0.0, east), altitude)
        };
        let route = Route {
            way_points: vec![at(0.0), at(40_000.0)],
            ..Route::default()
        };
        let ground = RouteGround {
            height_at: &ridge,
            take_off: 0.0,
            is_level: false,
        };
        let frame = LocalFrame::new(Geodetic::from_degrees(46.0, -92.0, 0.0));
        let way = FlownWay::along(&route, &frame, &ground, 0.5);
        let heights = way.targets.iter().map(|it| it.height);
        let lowest = heights.fold(f64::INFINITY, f64::min);
        // Within 25 m of the top.
        assert!((40.0..=44.0).contains(&lowest), "{lowest}");
    }

    #[test]
    fn a_circle_over_a_no_fly_area_is_told_of_the_leg_that_leads_to_it() {
        let at = |north, east| {
            let altitude = Altitude::new(120.0, AltitudeFrame::AboveGround);
            WayPoint::new(GroundPoint::new(north, east), altitude)
        };
        let mut way_points = vec![
            at(0.0, 0.0),
            at(0.0, 500.0),
            at(0.0, 1000.0),
            at(0.0, 1900.0),
        ];
        way_points[2].action = WayPointAction::Loiter {
            radius: 150.0,
            turns: 2.0,
        };
        let route = Route {
            way_points,
            ..Route::default()
        };
        let ground = RouteGround {
            height_at: &|_| 0.0,
            take_off: 0.0,
            is_level: true,
        };
        let frame = LocalFrame::new(Geodetic::from_degrees(46.0, -92.0, 0.0));
        let bank = planned_aircraft().bank_limit;
        let way = FlownWay::along(&route, &frame, &ground, bank);
        let corners = [
            (-60.0, 950.0),
            (-60.0, 1050.0),
            (-300.0, 1050.0),
            (-300.0, 950.0),
        ];
        let zone = NoFlyZone {
            corners: corners.map(|(n, e)| GroundPoint::new(n, e)).to_vec(),
            ..NoFlyZone::default()
        };
        let drawn: Vec<GroundPoint> = route.way_points.iter().map(|w| w.position).collect();
        assert!(incursions(&drawn, std::slice::from_ref(&zone)).is_empty());
        let found = way.incursions(&[zone]);
        let legs: Vec<usize> = found.iter().map(|it| it.leg).collect();
        assert_eq!(legs, [1]);
        // Two circles cross its 100 m twice.
        assert!(
            (200.0..240.0).contains(&found[0].length()),
            "{}",
            found[0].length()
        );
    }
}
