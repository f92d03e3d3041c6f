//! The winds of a flight, in words.

use pilotage_core::flight::Flight;
use pilotage_core::instruments::{GpsWindSettings, compare_winds};

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
        "    wind from GPS, unscented filter (DeAngelo 2016, Table 4): at the end north {:.2}, east {:.2} m/s \
         (deviations {:.2}, {:.2})",
        last.wind.x,
        last.wind.y,
        last.covariance[(0, 0)].sqrt(),
        last.covariance[(1, 1)].sqrt()
    );
    if let Some(fit) = found.by_least_squares {
        let from = found.from_least_squares;
        println!(
            "    by least squares: north {:.2}, east {:.2} m/s{}",
            fit.x,
            fit.y,
            apart(from)
        );
    }
    let autopilot = found.by_autopilot.values().last();
    match autopilot {
        Some(wind) => println!(
            "    by the autopilot: at the end north {:.2}, east {:.2} m/s{}",
            wind.x,
            wind.y,
            apart(found.from_autopilot)
        ),
        None => println!("    by the autopilot: not in the log"),
    }
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
