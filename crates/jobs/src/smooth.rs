//! A run smoothed: every step estimated from all of the flight, before and after it.

use pilotage_core::navigator::{Run, smooth};
use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole};
use super::running::once;
use super::{JobEvent, RunningJob, WorkerState};

/// Run to be smoothed: event `Smoothed`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SmoothOrder(pub Box<Run>);

impl Order for SmoothOrder {
    const URGENCY: Urgency = Urgency::Awaited;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |_, emit| {
            let run = self.0;
            let estimates = smooth(&run).map_err(|cause| cause.to_string())?;
            let places = run.steps.iter().zip(&estimates).map(|(step, estimate)| {
                let place = estimate.position();
                (step.time, place.north, place.east)
            });
            emit(JobEvent::Smoothed(places.collect()));
            Ok(())
        })
    }
}
