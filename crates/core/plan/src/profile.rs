//! The heights of a route over the ground, along it.

use pilotage_base::frames::{AltitudeFrame, AltitudeReference, GroundPoint};
use pilotage_mission::mission::{Route, WayPoint};

/// Distances at which the heights of a route are looked at.
const SAMPLES: usize = 240;

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

/// Heights along `route`, see [`on_leg`].
pub fn profile(
    route: &Route,
    ground: &dyn Fn(&GroundPoint) -> f64,
    take_off: f64,
) -> Vec<ProfileSample> {
    let length = route.length();
    let mut samples = Vec::new();
    let mut before = 0.0;
    for pair in route.way_points.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        let leg = a.position.distance(&b.position);
        let at = on_leg((a, b), ground, take_off);
        let parts = ((leg / length.max(1.0)) * SAMPLES as f64).ceil().max(1.0) as usize;
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
        let followed = profile(&route(AltitudeFrame::AboveGround), &hill, 400.0);
        let least = lowest(&followed).unwrap();
        assert!((least.flown - least.ground - 100.0).abs() < 1e-9);
        let level = profile(&route(AltitudeFrame::AboveTakeOff), &hill, 400.0);
        let least = lowest(&level).unwrap();
        assert!(
            (least.flown - least.ground - 40.0).abs() < 1e-9,
            "{least:?}"
        );
        assert!((least.distance - 500.0).abs() < 5.0);
        assert_eq!(level.last().unwrap().distance, 1000.0);
    }
}
