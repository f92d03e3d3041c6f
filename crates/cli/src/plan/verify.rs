//! Flies a plan again and again, over ground that looks otherwise every time, beside its prediction.

use pilotage_core::plan::{RoutePrediction, Verification};
use pilotage_jobs::{JobEvent, PredictionOrder, RehearseOrder, Rehearsed};

use super::planned_flight::PlannedFlight;
use crate::workers;

/// Flies seeds `first..end` beside `prediction`, with pictures or as stated; `hear` is told each flight in the order of
/// the seeds.
pub fn fly(
    ground: &PlannedFlight,
    plan: &PredictionOrder,
    prediction: &RoutePrediction,
    (first, end): (u64, u64),
    as_stated: bool,
    hear: &mut dyn FnMut(u64, Rehearsed),
) -> Result<(), String> {
    let order = |seed| RehearseOrder {
        plan: plan.clone(),
        prediction: prediction.clone(),
        map: ground.source.clone(),
        as_stated,
        seed,
    };
    let orders = (first..end).map(order).collect();
    workers::run(orders, &ground.lent(), &mut |number, event| {
        let seed = first + number as u64;
        match event {
            JobEvent::Failed(why) => return Err(format!("seed {seed}: {why}")),
            JobEvent::Figures(_) => hear(seed, event.read_figures()?),
            _ => {}
        }
        Ok(())
    })
}

/// Flies seeds and compares their errors with `prediction`.
pub fn verify(
    ground: &PlannedFlight,
    plan: &PredictionOrder,
    prediction: &RoutePrediction,
    seeds: (u64, u64),
    as_stated: bool,
) -> Result<Verification, String> {
    let mut all = Vec::new();
    let mut hear = |seed, flown: Rehearsed| {
        tell(seed, &flown);
        all.push(flown.frames);
    };
    fly(ground, plan, prediction, seeds, as_stated, &mut hear)?;
    Ok(Verification::of(&all))
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
