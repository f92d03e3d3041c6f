//! The order of places and velocities in sentences of a receiver: which of the two of a moment is said first.

use pilotage_base::frames::units::EARTH_RADIUS;

/// A day in seconds.
const DAY: f64 = 86_400.0;
/// Longest step between moments that tells a velocity, seconds.
const LONGEST: f64 = 10.0;
/// Velocities that differ by less do not tell to which of two moments one belongs, m/s.
const ALIKE: f64 = 0.05;

/// Sentence that a receiver said, as far as the order depends on it.
pub(super) enum SaidMotion {
    /// The second of the day, and latitude and longitude in degrees.
    Place(f64, [f64; 2]),
    /// Course in radians and speed in m/s; `None` where they are not told.
    Velocity(Option<[f64; 2]>),
}

/// A moment, and the velocity that was said behind its places and before those of the next, towards north and east in m/s.
struct SaidMoment {
    second: f64,
    place: [f64; 2],
    behind: Option<[f64; 2]>,
}

/// Whether velocities come before the places of their moments. Where a recording begins and ends within a cycle, only the
/// track can tell: most velocities are those of the step at the place behind them, rather than at the place before them.
pub(super) fn velocity_leads(said: impl Iterator<Item = SaidMotion>) -> bool {
    let is_velocity = |said: Option<&SaidMotion>| matches!(said, Some(SaidMotion::Velocity(_)));
    let mut said = said.peekable();
    if !is_velocity(said.peek()) {
        return false;
    }
    let said: Vec<SaidMotion> = said.collect();
    if is_velocity(said.last()) {
        return false;
    }
    let moments = moments(&said);
    let (mut before, mut behind) = (0, 0);
    for four in moments.windows(4) {
        let Some(said) = four[1].behind else { continue };
        let steps = step(&four[0], &four[2]).zip(step(&four[1], &four[3]));
        let Some((own, next)) = steps else { continue };
        let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        if apart(own, next) < ALIKE {
            continue;
        }
        if apart(said, next) < apart(said, own) {
            before += 1;
        } else {
            behind += 1;
        }
    }
    before >= behind
}

fn moments(said: &[SaidMotion]) -> Vec<SaidMoment> {
    let mut moments: Vec<SaidMoment> = Vec::new();
    for said in said {
        match said {
            SaidMotion::Place(second, place) => {
                if moments.last().is_none_or(|last| last.second != *second) {
                    moments.push(SaidMoment {
                        second: *second,
                        place: *place,
                        behind: None,
                    });
                }
            }
            SaidMotion::Velocity(velocity) => {
                if let Some(last) = moments.last_mut() {
                    last.behind = velocity.map(|[course, speed]| {
                        let (sin, cos) = course.sin_cos();
                        [speed * cos, speed * sin]
                    });
                }
            }
        }
    }
    moments
}

/// Mean velocity from a moment to another, towards north and east in m/s; `None` of those far apart.
fn step(from: &SaidMoment, to: &SaidMoment) -> Option<[f64; 2]> {
    let lasts = (to.second - from.second).rem_euclid(DAY);
    let is_near = lasts > 0.0 && lasts <= 2.0 * LONGEST;
    is_near.then(|| metres_between(from.place, to.place).map(|metres| metres / lasts))
}

/// Metres towards north and east from one place near to another; latitudes and longitudes are in degrees.
pub(super) fn metres_between(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    let [north, east] = [0, 1].map(|i| EARTH_RADIUS * (to[i] - from[i]).to_radians());
    [north, east * from[0].to_radians().cos()]
}
