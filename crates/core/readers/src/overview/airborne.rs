//! When it was in the air.

use super::super::interpret::{Role, RoleSeries};
use pilotage_flight::stretches::{
    FLYING_SHARE, HOVERING, LEAST, STANDING, stretches, stretches_within,
};

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
    if flying.is_empty()
        && of(Role::BarometricHeight).is_none()
        && let Some(height) = of(Role::HeightAboveGround)
    {
        // Photos tell no speeds, and all of them may be taken at one height: that above the ground counts.
        let flying = pairs(height).map(|(time, h)| (time, h > HOVERING));
        return stretches_within(flying, usual_pause(&height.times));
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
