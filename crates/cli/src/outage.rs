//! GPS outages all along a flight: how far off dead reckoning is at their ends.

use pilotage_core::flight::Flight;
use pilotage_core::instruments::OutageStudy;
use pilotage_core::navigator::Run;
use pilotage_jobs::{JobEvent, OpenFlight, Outage, OutageOrder};

use crate::CommandResult;
use crate::workers::{self, Lent};

/// Prints a line for each way to navigate without GPS, for outages of so many seconds all along the time in the air; one of
/// them by what the pictures of a run over it showed, where there is one.
pub fn study(flight: &Flight, run: Option<&Run>, seconds: f64) -> CommandResult {
    let order = OutageOrder {
        flight: Lent::flight(),
        outage: Outage::AllAlong(seconds),
        seen: run.and_then(OutageOrder::seen_by),
    };
    let lent = Lent::default().with_flight(&OpenFlight::without_pictures(flight.clone()));
    println!("without GPS for {seconds:.0} s, again and again along the flight:");
    workers::run(vec![order], &lent, &mut |_, event| {
        match event {
            JobEvent::Failed(why) => return Err(why),
            JobEvent::OutagesStudied(report) => report.studies.iter().for_each(print),
            _ => {}
        }
        Ok(())
    })?;
    Ok(())
}

fn print(study: &OutageStudy) {
    println!(
        "    {:32} {:4} outages, off at the end {:6.1} m median, {:6.1} m in 90 %; the 95 % ellipse holds {:.0} %",
        study.label,
        study.outages.len(),
        study.error_quantile(0.5),
        study.error_quantile(0.9),
        100.0 * study.covered()
    );
}
