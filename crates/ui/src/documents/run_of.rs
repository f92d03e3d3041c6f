//! The flight of which a run was made, told by the readings that the run holds.

use pilotage_core::flight::Flight;
use pilotage_core::frames::wrap_pi;
use pilotage_core::navigator::{Control, Run, SensorFault, StepReport};

/// Number of steps that are looked at.
const LOOKED_AT: usize = 64;
/// Readings closer than this are the same: what another platform computed differs in the last digits.
const SAME_READING: f64 = 1e-6;

/// Whether a run was made of a flight: its steps hold what the instruments of that say.
pub fn is_run_of(run: &Run, flight: &Flight) -> bool {
    let every = 1 + run.steps.len() / LOOKED_AT;
    let mut steps = run.steps.iter().step_by(every);
    steps.all(|step| is_step_of(step, flight))
}

fn is_step_of(step: &StepReport, flight: &Flight) -> bool {
    let (flown, read) = (&step.control, Control::of(flight, step.time));
    let is_same = |a: f64, b: f64| (a - b).abs() < SAME_READING;
    let is_airspeed = match (flown.airspeed, read.airspeed) {
        (Some(a), Some(b)) => is_same(a, b),
        (a, b) => a == b,
    };
    // A compass that is found to be turned is turned back in the run, not in the flight.
    let is_turned = |why| matches!(why, SensorFault::Turned { .. });
    let is_heading = step.doubts.iter().any(|doubt| is_turned(doubt.why))
        || is_same(wrap_pi(flown.heading - read.heading), 0.0);
    is_airspeed
        && is_heading
        && is_same(flown.roll, read.roll)
        && is_same(flown.pitch, read.pitch)
        && is_same(flown.height, read.height)
}
