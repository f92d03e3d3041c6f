//! GPS outages all along a flight: how far off dead reckoning is at their ends.

use pilotage_core::flight::Flight;
use pilotage_core::instruments::{Instruments, OutagePlan, ReckonSettings, Way, study_cuts};

use crate::Outcome;

/// Prints a line for each way to navigate without GPS, for outages of so many seconds all along the time in the air.
pub fn study(flight: &Flight, seconds: f64) -> Outcome {
    let instruments = Instruments::of(flight, None)?;
    let mut ways = vec![Way::air_and_wind(), Way::plain()];
    if instruments.has_gyros() {
        ways.push(Way::by_gyros());
    }
    let plan = OutagePlan {
        length: seconds,
        ..OutagePlan::default()
    };
    println!("without GPS for {seconds:.0} s, again and again along the flight:");
    for way in ways {
        let settings = ReckonSettings::default();
        let study = study_cuts(&instruments, &way, &plan, &settings, &mut |_| true)?;
        if study.cuts.is_empty() {
            let (start, end) = instruments.stretch;
            return Err(format!(
                "{}: {:.0} s in the air are too few for GPS outages of {seconds:.0} s; say a shorter --outage",
                flight.name,
                end - start
            )
            .into());
        }
        println!(
            "    {:32} {:4} outages, off at the end {:6.1} m median, {:6.1} m in 90 %; the 95 % ellipse holds {:.0} %",
            study.label,
            study.cuts.len(),
            study.error_quantile(0.5),
            study.error_quantile(0.9),
            100.0 * study.covered()
        );
    }
    Ok(())
}
