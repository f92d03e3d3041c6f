//! The winds of a flight, in words.

use nalgebra::Vector2;
use pilotage_core::flight::Flight;
use pilotage_core::instruments::{GpsWindSettings, compare_winds};
use pilotage_core::simulate::Wind;

/// Prints the wind by the filter from GPS, by least squares and by the autopilot, and how far they are
/// apart; nothing of a flight without the instruments for it.
pub fn describe(flight: &Flight) {
    let Ok(found) = compare_winds(
        flight,
        &GpsWindSettings::default(),
        GpsWindSettings::SETTLED,
    ) else {
        return;
    };
    let Some(last) = found.by_gps.last() else {
        return;
    };
    println!(
        "    wind from GPS, unscented filter (DeAngelo 2016, Table 4): at the end {} (standard deviation to the north \
         {:.2}, to the east {:.2} m/s)",
        blowing(&last.wind),
        last.covariance[(0, 0)].sqrt(),
        last.covariance[(1, 1)].sqrt()
    );
    if let Some(fit) = found.by_least_squares {
        let from = found.from_least_squares;
        println!("    by least squares: {}{}", blowing(&fit), apart(from));
    }
    let autopilot = found.by_autopilot.values().last();
    match autopilot {
        Some(wind) => println!(
            "    by the autopilot: at the end {}{}",
            blowing(wind),
            apart(found.from_autopilot)
        ),
        None => println!("    by the autopilot: not in the log"),
    }
}

/// A wind by where it comes from, of its velocity (north, east), m/s.
fn blowing(velocity: &Vector2<f64>) -> String {
    let Wind { speed, from } = Wind::of_velocity(velocity);
    // 359.6° is north.
    let degrees = from.to_degrees().rem_euclid(360.0).round() % 360.0;
    format!("{speed:.2} m/s from {degrees:.0}°")
}

/// Difference of the filter's wind from another one, in words.
fn apart(rms: Option<f64>) -> String {
    rms.map_or_else(String::new, |rms| {
        format!(
            "; the filter differs from it by {rms:.2} m/s RMS from {:.0} s after take-off on",
            GpsWindSettings::SETTLED
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wind_is_told_by_where_it_comes_from() {
        // Air that moves to the east and south comes from the north-west.
        assert_eq!(blowing(&Vector2::new(-3.0, 3.0)), "4.24 m/s from 315°");
        assert_eq!(blowing(&Vector2::new(-2.0, 0.001)), "2.00 m/s from 0°");
    }
}
