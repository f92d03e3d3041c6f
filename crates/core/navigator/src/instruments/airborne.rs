//! When it was in the air.

use super::readings::Readings;
use super::series::LONGEST_GAP;
use super::statistics::quantile;
use pilotage_flight::stretches::{FLYING_SHARE, HOVERING, STANDING, stretches};

/// Airspeed, in multiples of what stands, that nine of ten of an airplane's samples in the air do not stay below.
const AIRPLANE: f64 = 2.0;

/// Stretches in the air, seconds: faster, through the air or over ground, than a third of its fast speeds, or
/// well above where it began if it is nothing that needs speed. A multirotor that hovers flies, with an airspeed that
/// shows nothing or without one.
///
/// Of both speeds the larger counts, since flying against the wind is slow over ground, and an airspeed may be
/// missing or stuck; but what stands on the ground does not fly however strong the wind or wrong the zero of the
/// airspeed.
///
/// ```
/// use pilotage_navigator::instruments::{Readings, airborne};
///
/// // Stands for 20 s, flies at 17 m/s for 60 s, stands again.
/// let mut readings = Readings::default();
/// for i in 0..100 {
///     let time = f64::from(i);
///     readings.airspeed.push(time, if (20..80).contains(&i) { 17.0 } else { 0.3 });
/// }
/// assert_eq!(airborne(&readings), [(20.0, 79.0)]);
/// ```
pub fn airborne(readings: &Readings) -> Vec<(f64, f64)> {
    let ground_speed = |time| readings.velocities.at(time).map(|v| v.norm());
    let speed = |time: f64| {
        let (ground, air) = (ground_speed(time), readings.airspeed.at(time));
        match ground {
            Some(ground) if ground < STANDING => Some(ground),
            _ => [ground, air].into_iter().flatten().reduce(f64::max),
        }
    };
    let speeds: Vec<(f64, f64)> = times(readings)
        .into_iter()
        .filter_map(|time| Some((time, speed(time)?)))
        .collect();
    let sorted = speeds.iter().map(|(_, speed)| *speed).collect();
    let least = (FLYING_SHARE * quantile(sorted, 0.9)).max(STANDING);
    let airspeeds = readings.airspeed.values().to_vec();
    let needs_speed = quantile(airspeeds, 0.9) > AIRPLANE * STANDING;
    let ground = if readings.is_above_ground {
        Some(0.0)
    } else {
        readings.height.values().first().copied()
    };
    let hovers = |time| {
        let height = readings.height.at(time).zip(ground);
        !needs_speed && height.is_some_and(|(h, ground)| h - ground > HOVERING)
    };
    if speeds.is_empty() {
        let heights = readings.height.times().iter();
        return stretches(heights.map(|time| (*time, hovers(*time))));
    }
    let flying = speeds
        .iter()
        .map(|(time, speed)| (*time, *speed > least || hovers(*time)));
    stretches(flying)
}

/// When a speed is known: at the velocities over ground, and while they pause at the airspeeds.
fn times(readings: &Readings) -> Vec<f64> {
    let (velocities, airspeed) = (&readings.velocities, &readings.airspeed);
    let mut times = Vec::new();
    let mut last: Option<f64> = None;
    for time in velocities.times() {
        if let Some(last) = last.filter(|last| time - last > LONGEST_GAP) {
            times.extend(airspeed.between(last, *time).map(|(time, _)| time));
        }
        times.push(*time);
        last = Some(*time);
    }
    if times.is_empty() {
        times.extend_from_slice(airspeed.times());
    }
    times
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;

    #[test]
    fn a_flight_goes_on_while_satellite_navigation_pauses() {
        let mut readings = Readings::default();
        for i in 0..600 {
            let time = 0.1 * f64::from(i);
            readings.airspeed.push(time + 0.03, 17.0);
            if !(20.0..45.0).contains(&time) {
                readings.velocities.push(time, Vector2::new(15.0, 0.0));
            }
        }
        let whole = airborne(&readings);
        assert!(
            whole.len() == 1 && whole[0].1 - whole[0].0 > 59.0,
            "{whole:?}"
        );
        readings.airspeed = crate::instruments::Series::new();
        assert_eq!(
            airborne(&readings).len(),
            2,
            "nothing tells of the time between"
        );
    }

    #[test]
    fn who_hovers_flies_and_who_stands_does_not() {
        let mut readings = Readings::default();
        for i in 0..600 {
            let time = 0.1 * f64::from(i);
            readings.velocities.push(time, Vector2::zeros());
            let is_up = (10.0..50.0).contains(&time);
            readings
                .height
                .push(time, if is_up { 104.0 } else { 100.0 });
            // A tube without a wind in it.
            readings.airspeed.push(time, 0.5 + 0.5 * time.sin());
        }
        let flown = airborne(&readings);
        assert!(flown.len() == 1, "{flown:?}");
        assert!((flown[0].0 - 10.0).abs() < 0.2 && (flown[0].1 - 49.9).abs() < 0.2);
        readings.velocities = crate::instruments::Series::new();
        readings.airspeed = crate::instruments::Series::new();
        assert_eq!(airborne(&readings).len(), 1, "by its height alone");
        readings.height = crate::instruments::Series::new();
        assert_eq!(airborne(&readings), []);
    }
}
