//! When it was in the air.

use super::super::interpret::{Role, RoleSeries};
use pilotage_base::frames::units::EARTH_RADIUS;
use pilotage_flight::stretches::{
    FLYING_SHARE, HOVERING, LEAST, STANDING, stretches, stretches_within,
};

/// Kind of fix from which on a receiver tells heights.
const FIX: f64 = 3.0;
/// Longest time between places that tell a speed, and half the time over which they do, seconds.
const TRACK_STEP: f64 = 1.5;
/// Height above the ground by satellite navigation alone from which on it hovers at least, metres: it wanders by some.
const HOVERING_BY_GPS: f64 = 10.0;

/// Stretches in the air, seconds in the log's time base: faster over ground than a third of its fast
/// speeds, or well above where it began, or above the ground where that is known and no speed is.
pub fn airborne(found: &[RoleSeries]) -> Vec<(f64, f64)> {
    let of = |role| found.iter().find(|s: &&RoleSeries| s.role == role);
    let mut flying: Vec<(f64, bool)> = Vec::new();
    if let (Some(north), Some(east)) = (of(Role::GpsVelocityNorth), of(Role::GpsVelocityEast)) {
        let speeds = north.times.iter().zip(&north.values);
        let speeds: Vec<(f64, f64)> = speeds
            .filter_map(|(time, n)| Some((*time, n.hypot(east.at(*time)?))))
            .collect();
        let least = (FLYING_SHARE * fast(&speeds)).max(STANDING);
        flying.extend(speeds.iter().map(|(time, speed)| (*time, *speed > least)));
    } else if let Some(airspeed) = of(Role::Airspeed) {
        let speeds: Vec<(f64, f64)> = pairs(airspeed).collect();
        let least = (FLYING_SHARE * fast(&speeds)).max(STANDING);
        flying.extend(speeds.iter().map(|(time, speed)| (*time, *speed > least)));
    }
    // Photos are too far apart for that, and tell no speed.
    if flying.is_empty() {
        let speeds = match of(Role::GroundSpeed) {
            Some(speed) => pairs(speed).collect(),
            None => speeds_of_track(&of),
        };
        let least = (FLYING_SHARE * fast(&speeds)).max(STANDING);
        flying.extend(speeds.iter().map(|(time, speed)| (*time, *speed > least)));
    }
    if flying.is_empty()
        && of(Role::BarometricHeight).is_none()
        && let Some(height) = of(Role::HeightAboveGround)
    {
        // Photos tell no speeds, and all of them may be taken at one height: that above the ground counts.
        let flying = pairs(height).map(|(time, h)| (time, h > HOVERING));
        return stretches_within(flying, usual_pause(&height.times));
    }
    if of(Role::BarometricHeight).is_none() && !flying.is_empty() {
        let is_high = height_of_slow_flight(&of);
        for (time, is_flying) in &mut flying {
            *is_flying |= is_high(*time);
        }
    }
    let height = of(Role::BarometricHeight).or_else(|| of(Role::GpsHeight));
    if let Some(height) = height {
        let ground = height.values[0];
        let is_high = |time: f64| height.at(time).is_some_and(|h| h - ground > HOVERING);
        if flying.is_empty() {
            flying.extend(pairs(height).map(|(time, h)| (time, h - ground > HOVERING)));
        } else {
            for (time, is_flying) in &mut flying {
                // Speed alone may be a car, height alone a hill: a slow aircraft needs height.
                *is_flying |= is_high(*time) && of(Role::BarometricHeight).is_some();
            }
        }
    }
    stretches(flying)
}

/// Speeds over ground, metres a second, by places that are some seconds apart, so that a receiver's noise at rest is none;
/// none where places are farther apart.
fn speeds_of_track<'a>(of: &impl Fn(Role) -> Option<&'a RoleSeries>) -> Vec<(f64, f64)> {
    let (Some(latitude), Some(longitude)) = (of(Role::Latitude), of(Role::Longitude)) else {
        return Vec::new();
    };
    let place = |time: f64| Some((latitude.at(time)?, longitude.at(time)?));
    let steps = latitude
        .times
        .windows(2)
        .filter(|w| w[1] - w[0] <= TRACK_STEP);
    if 2 * steps.count() < latitude.times.len() {
        return Vec::new();
    }
    let speed = |time: f64| {
        let from = latitude.times.partition_point(|t| *t < time - TRACK_STEP);
        let to = latitude.times.partition_point(|t| *t <= time + TRACK_STEP);
        let (from, to) = (
            *latitude.times.get(from)?,
            *latitude.times.get(to.checked_sub(1)?)?,
        );
        let ((lat, lon), (last_lat, last_lon)) = (place(from)?, place(to)?);
        let way = (last_lat - lat).hypot((last_lon - lon) * lat.cos()) * EARTH_RADIUS;
        (to > from).then(|| (time, way / (to - from)))
    };
    latitude
        .times
        .iter()
        .filter_map(|time| speed(*time))
        .collect()
}

/// Whether a slow aircraft without a barometer is high: above the ground as it was measured, else well above the least
/// heights of a receiver with a fix.
fn height_of_slow_flight<'a>(
    of: &impl Fn(Role) -> Option<&'a RoleSeries>,
) -> Box<dyn Fn(f64) -> bool + 'a> {
    if let Some(height) = of(Role::HeightAboveGround) {
        return Box::new(move |time| height.at(time).is_some_and(|h| h > HOVERING));
    }
    let Some(height) = of(Role::GpsHeight) else {
        return Box::new(|_| false);
    };
    // A fix says nothing of heights that the autopilot estimates.
    let own = of(Role::AutopilotHeight);
    let is_measured = own.is_none_or(|own| own.source != height.source);
    let fix = of(Role::GpsFix).filter(|_| is_measured);
    let is_fixed = move |time: f64| fix.is_none_or(|fix| fix.at(time).is_some_and(|f| f >= FIX));
    let fixed = pairs(height).filter(|(time, _)| is_fixed(*time));
    let mut heights: Vec<f64> = fixed.map(|(_, height)| height).collect();
    heights.sort_by(f64::total_cmp);
    let ground = heights.get(heights.len() / 20).copied();
    Box::new(move |time| {
        let above = height
            .at(time)
            .zip(ground)
            .map(|(height, ground)| height - ground);
        is_fixed(time) && above.is_some_and(|above| above > HOVERING_BY_GPS)
    })
}

fn pairs(series: &RoleSeries) -> impl Iterator<Item = (f64, f64)> + '_ {
    series
        .times
        .iter()
        .copied()
        .zip(series.values.iter().copied())
}

/// The speed that nine of ten samples stay below.
fn fast(speeds: &[(f64, f64)]) -> f64 {
    let mut sorted: Vec<f64> = speeds.iter().map(|(_, speed)| *speed).collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() * 9 / 10).copied().unwrap_or(0.0)
}

/// Longest time between two neighbours of which nothing is missing, seconds: twice the usual one.
fn usual_pause(times: &[f64]) -> f64 {
    let mut steps: Vec<f64> = times.windows(2).map(|w| w[1] - w[0]).collect();
    steps.sort_by(f64::total_cmp);
    let usual = steps.get(steps.len() / 2);
    usual.map_or(LEAST, |usual| LEAST.max(2.0 * usual))
}
