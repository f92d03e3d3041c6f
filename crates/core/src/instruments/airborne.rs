//! When it was in the air.

use super::readings::Readings;
use super::statistics::quantile;
use crate::flight::overview::{FLYING_SHARE, HOVERING, STANDING, stretches};

/// Stretches in the air, seconds: faster, through the air or over ground, than a third of its fast speeds, or
/// well above where it began if it is nothing that needs speed.
///
/// Of both speeds the larger counts, since flying against the wind is slow over ground, and an airspeed may be
/// missing or stuck; but what stands on the ground does not fly however strong the wind or wrong the zero of the
/// airspeed.
pub fn airborne(readings: &Readings) -> Vec<(f64, f64)> {
    let ground_speed = |time| readings.velocities.at(time).map(|v| v.norm());
    let has_ground = !readings.velocities.is_empty();
    let times = if has_ground {
        readings.velocities.times()
    } else {
        readings.airspeed.times()
    };
    let speed = |time: f64| {
        let (ground, air) = (ground_speed(time), readings.airspeed.at(time));
        match ground {
            Some(ground) if ground < STANDING => Some(ground),
            _ => [ground, air].into_iter().flatten().reduce(f64::max),
        }
    };
    let speeds: Vec<(f64, f64)> = times
        .iter()
        .filter_map(|time| Some((*time, speed(*time)?)))
        .collect();
    let sorted = speeds.iter().map(|(_, speed)| *speed).collect();
    let least = (FLYING_SHARE * quantile(sorted, 0.9)).max(STANDING);
    let ground = readings.height.values().first().copied();
    let hovers = |time| {
        let height = readings.height.at(time).zip(ground);
        readings.airspeed.is_empty() && height.is_some_and(|(h, ground)| h - ground > HOVERING)
    };
    let flying = speeds
        .iter()
        .map(|(time, speed)| (*time, *speed > least || hovers(*time)));
    stretches(flying)
}
