//! The heights of a route over the ground, along it.

use pilotage_base::frames::{AltitudeFrame, AltitudeReference, GroundPoint};
use pilotage_mission::mission::{Route, WayPoint, WayPointAction};

/// Distances at which the heights of a route are looked at, at least and at most.
const SAMPLES: f64 = 240.0;
/// See [`SAMPLES`].
const MOST_SAMPLES: f64 = 4096.0;
/// Height above ground up to which an aircraft counts as on it, metres.
const ON_THE_GROUND: f64 = 1.0;

/// Heights at one place of a route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileSample {
    /// Place on the ground.
    pub place: GroundPoint,
    /// Distance along the route, metres.
    pub distance: f64,
    /// Height of the route above mean sea level, metres.
    pub flown: f64,
    /// Height of the ground above mean sea level, metres.
    pub ground: f64,
}

impl ProfileSample {
    /// Height above ground, metres.
    pub fn above(&self) -> f64 {
        self.flown - self.ground
    }
}

/// Heights on the leg from `a` to `b`, by the share of it that is flown, without the distance: between
/// way-points above ground the height above ground changes evenly, elsewhere that above mean sea level.
pub fn on_leg<'a>(
    (a, b): (&'a WayPoint, &'a WayPoint),
    ground: &'a dyn Fn(&GroundPoint) -> f64,
    take_off: f64,
) -> impl Fn(f64) -> ProfileSample + 'a {
    let follows = [a, b]
        .iter()
        .all(|w| w.altitude.frame == AltitudeFrame::AboveGround);
    let amsl = move |w: &WayPoint| {
        let reference = AltitudeReference {
            take_off,
            ground: ground(&w.position),
        };
        w.altitude.amsl(&reference)
    };
    let (from, to) = (amsl(a), amsl(b));
    move |share| {
        let between = |from: f64, to: f64| from + share * (to - from);
        let place = GroundPoint::new(
            between(a.position.north, b.position.north),
            between(a.position.east, b.position.east),
        );
        let below = ground(&place);
        let flown = if follows {
            below + between(a.altitude.metres, b.altitude.metres)
        } else {
            between(from, to)
        };
        ProfileSample {
            place,
            distance: 0.0,
            flown,
            ground: below,
        }
    }
}

/// Heights along `route`, see [`on_leg`], at most `step` metres apart, as far as that is not too many.
pub fn profile(
    route: &Route,
    ground: &dyn Fn(&GroundPoint) -> f64,
    take_off: f64,
    step: f64,
) -> Vec<ProfileSample> {
    let length = route.length();
    let wanted = (length / step.max(1e-3)).clamp(SAMPLES, MOST_SAMPLES);
    let mut samples = Vec::new();
    let mut before = 0.0;
    for pair in route.way_points.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        let leg = a.position.distance(&b.position);
        let at = on_leg((a, b), ground, take_off);
        let parts = ((leg / length.max(1.0)) * wanted).ceil().max(1.0) as usize;
        let first = usize::from(!samples.is_empty());
        for part in first..=parts {
            let share = part as f64 / parts as f64;
            samples.push(ProfileSample {
                distance: before + share * leg,
                ..at(share)
            });
        }
        before += leg;
    }
    samples
}

/// Part of a route's heights that is flown in the air.
#[derive(Clone, Copy, Debug)]
pub struct AirbornePart<'a> {
    /// Heights between take-off and landing.
    pub samples: &'a [ProfileSample],
    /// Whether a leg that begins on the ground is left out before them.
    pub takes_off: bool,
    /// Whether a leg to the landing is left out behind them.
    pub lands: bool,
}

/// Heights `samples` of a route without the leg to its landing and one from a take-off on the ground; all of them where no
/// others are left.
pub fn airborne<'a>(route: &Route, samples: &'a [ProfileSample]) -> AirbornePart<'a> {
    let leg = |pair: &[WayPoint]| pair[0].position.distance(&pair[1].position);
    let mut legs = route.way_points.windows(2);
    let first = route.way_points.first().map(|it| it.action);
    let is_low = samples
        .first()
        .is_some_and(|it| it.above() <= ON_THE_GROUND);
    let takes_off = first == Some(WayPointAction::TakeOff) && is_low;
    let lands = route.lands();
    let begin = legs.next().map_or(0.0, leg);
    let end = route.length() - route.way_points.windows(2).next_back().map_or(0.0, leg);
    // Rounding may put the way-points themselves to either side.
    let from = samples.partition_point(|it| takes_off && it.distance < begin - 1e-6);
    let to = samples.partition_point(|it| !lands || it.distance <= end + 1e-6);
    match samples.get(from..to) {
        Some(samples) if samples.len() > 1 => AirbornePart {
            samples,
            takes_off,
            lands,
        },
        _ => AirbornePart {
            samples,
            takes_off: false,
            lands: false,
        },
    }
}

/// The sample that is nearest to the ground.
pub fn lowest(samples: &[ProfileSample]) -> Option<&ProfileSample> {
    let samples = samples.iter();
    samples.min_by(|a, b| a.above().total_cmp(&b.above()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_base::frames::Altitude;

    fn route(frame: AltitudeFrame) -> Route {
        let at = |e| WayPoint::new(GroundPoint::new(0.0, e), Altitude::new(100.0, frame));
        Route {
            way_points: vec![at(0.0), at(1000.0)],
            ..Route::default()
        }
    }

    /// A hill of 60 m in the middle, on ground at 400 m.
    fn hill(p: &GroundPoint) -> f64 {
        400.0 + 60.0 * (1.0 - ((p.east - 500.0) / 500.0).abs()).max(0.0)
    }

    #[test]
    fn above_ground_the_route_follows_the_hill_and_above_take_off_it_does_not() {
        let followed = profile(&route(AltitudeFrame::AboveGround), &hill, 400.0, 50.0);
        let least = lowest(&followed).unwrap();
        assert!((least.flown - least.ground - 100.0).abs() < 1e-9);
        let level = profile(&route(AltitudeFrame::AboveTakeOff), &hill, 400.0, 50.0);
        let least = lowest(&level).unwrap();
        assert!(
            (least.flown - least.ground - 40.0).abs() < 1e-9,
            "{least:?}"
        );
        assert!((least.distance - 500.0).abs() < 5.0);
        assert_eq!(level.last().unwrap().distance, 1000.0);
    }

    #[test]
    fn the_lowest_place_is_over_the_hill_and_not_where_it_lands() {
        let at = |east, metres| {
            let altitude = Altitude::new(metres, AltitudeFrame::AboveTakeOff);
            WayPoint::new(GroundPoint::new(0.0, east), altitude)
        };
        let mut way_points = vec![
            at(-400.0, 0.0),
            at(0.0, 75.0),
            at(1000.0, 75.0),
            at(2000.0, 0.0),
        ];
        way_points[0].action = WayPointAction::TakeOff;
        way_points[3].action = WayPointAction::Land;
        let mut route = Route {
            way_points,
            ..Route::default()
        };
        let found = |route: &Route| {
            let samples = profile(route, &hill, 400.0, 10.0);
            let part = airborne(route, &samples);
            let low = *lowest(part.samples).unwrap();
            (
                low.above().round(),
                low.distance.round(),
                part.takes_off,
                part.lands,
            )
        };
        assert_eq!(found(&route), (15.0, 900.0, true, true));
        // A take-off stated at the height to which it climbs is flown at that height.
        route.way_points[0].altitude = route.way_points[1].altitude;
        assert_eq!(found(&route), (15.0, 900.0, false, true));
        // Of a route that is nothing but a landing, all counts.
        route.way_points.drain(..2);
        assert_eq!(found(&route), (0.0, 1000.0, false, false));
    }

    #[test]
    fn a_hill_that_is_narrower_than_a_240th_of_the_way_is_not_passed_over() {
        // 60 km over ground at 400 m with a hill of 80 m, 100 m wide, between two of 240 places.
        let narrow =
            |p: &GroundPoint| 400.0 + 80.0 * (1.0 - ((p.east - 30_125.0) / 50.0).abs()).max(0.0);
        let mut route = route(AltitudeFrame::AboveTakeOff);
        route.way_points[1].position.east = 60_000.0;
        let least = |step| {
            let samples = profile(&route, &narrow, 400.0, step);
            lowest(&samples).unwrap().above()
        };
        assert!((least(f64::INFINITY) - 100.0).abs() < 1e-9);
        // Posts 30 m apart: within 15 m of the top.
        assert!(
            (20.0..=20.0 + 80.0 * 15.0 / 50.0).contains(&least(30.0)),
            "{}",
            least(30.0)
        );
    }
}
