//! `pilotage plan --calibrate`: whether landmarks are found as often as their assessment says.

use std::io::Write;

use pilotage_core::plan::{Pass, Reliability, cruise, random_places};
use pilotage_jobs::{JobEvent, ReliabilityOrder};

use super::arguments::Arguments;
use super::planned_flight::PlannedFlight;
use crate::workers;

/// Seed of the places and days where nobody states one.
const CALIBRATION_SEED: u64 = 1;

/// Flies about `passes` passes over places of every quality and compares what was found with what
/// their assessment on other days said.
pub fn calibrate(
    arguments: &Arguments,
    ground: &PlannedFlight,
    passes: usize,
) -> Result<Reliability, String> {
    let seed = arguments.seed.unwrap_or(CALIBRATION_SEED);
    let places = random_places(passes.div_ceil(ReliabilityOrder::PASSES), seed);
    let order = |place| ReliabilityOrder {
        about: ground.assessment(place, Some(seed)),
        speed: cruise(),
    };
    let orders = places.iter().map(order).collect();
    let begun = std::time::Instant::now();
    let mut all: Vec<Pass> = Vec::new();
    workers::run(orders, &ground.lent(), &mut |number, event| {
        match event {
            JobEvent::Failed(why) => return Err(why),
            JobEvent::Figures(_) => {
                all.extend(event.read_figures::<Vec<Pass>>()?);
                print!("\r{} of {} ", number + 1, places.len());
                let _ = std::io::stdout().flush();
            }
            _ => {}
        }
        Ok(())
    })?;
    println!();
    let reliability = Reliability::of(&all);
    for bin in reliability.bins.iter().filter(|b| b.passes > 0) {
        println!(
            "said {:.3}, observed {:.3} ± {:.3} in {} frames of {} passes",
            bin.predicted, bin.observed, bin.uncertainty, bin.frames, bin.passes
        );
    }
    println!(
        "false matches in {:.4} of the frames; {:.0} s",
        reliability.false_matches,
        begun.elapsed().as_secs_f64()
    );
    Ok(reliability)
}
