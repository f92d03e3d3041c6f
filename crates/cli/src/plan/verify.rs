//! Flies a plan again and again, over ground that looks otherwise every time, beside its prediction.

use pilotage_core::plan::{RoutePrediction, Verification};
use pilotage_jobs::{JobEvent, PredictionOrder, RehearseOrder, Rehearsed};

use super::planned_flight::PlannedFlight;
use crate::outcome::SeedFlights;
use crate::workers;

/// Flies seeds `first..end` beside `prediction`, with pictures or as stated; `hear` is told each flight in the order of
/// the seeds. Those that cannot be flown are told and counted.
pub fn fly(
    ground: &PlannedFlight,
    plan: &PredictionOrder,
    prediction: &RoutePrediction,
    (first, end): (u64, u64),
    as_stated: bool,
    hear: &mut dyn FnMut(u64, Rehearsed),
) -> Result<SeedFlights, String> {
    let order = |seed| RehearseOrder {
        plan: plan.clone(),
        prediction: prediction.clone(),
        map: ground.source.clone(),
        as_stated,
        seed,
    };
    let orders = (first..end).map(order).collect();
    let mut seeds = SeedFlights::of((first, end));
    workers::run(orders, &ground.lent(), &mut |number, event| {
        match event {
            JobEvent::Failed(why) => seeds.fail(number, &why),
            JobEvent::Figures(_) => hear(seeds.seed(number), event.read_figures()?),
            _ => {}
        }
        Ok(())
    })?;
    seeds.any()?;
    Ok(seeds)
}

/// Flies seeds and compares their errors with `prediction`; with the count of those that could not be flown.
pub fn verify(
    ground: &PlannedFlight,
    plan: &PredictionOrder,
    prediction: &RoutePrediction,
    seeds: (u64, u64),
    as_stated: bool,
) -> Result<(Verification, SeedFlights), String> {
    let mut all = Vec::new();
    let mut hear = |seed, flown: Rehearsed| {
        tell(seed, &flown);
        all.push(flown.frames);
    };
    let flown = fly(ground, plan, prediction, seeds, as_stated, &mut hear)?;
    Ok((Verification::of(&all), flown))
}

fn tell(seed: u64, flown: &Rehearsed) {
    let of = Verification::of(std::slice::from_ref(&flown.frames));
    eprintln!(
        "seed {seed}: {} frames, {} updated, {:.1} % inside the corridor, error {:.2} m RMS, \
         at most {:.1} m, where the filter believed {:.2} m (NEES {:.2})",
        of.frames,
        flown.corrected,
        100.0 * of.inside_corridor,
        of.rms_m,
        of.largest_m,
        of.believed_rms_m,
        of.mean_nees
    );
}
