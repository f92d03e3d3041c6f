//! A run smoothed: every step estimated from all of the flight, before and after it.

use pilotage_core::navigator::{Run, RunSmoothing};
use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole};
use super::running::slice;
use super::{Advance, JobEvent, RunningJob, WorkerState};

/// Steps that are smoothed between two looks at the clock.
const AT_A_TIME: usize = 32;

/// Run to be smoothed: event `Smoothed`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SmoothOrder(pub Box<Run>);

impl Order for SmoothOrder {
    const URGENCY: Urgency = Urgency::Awaited;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(Smooth {
            run: self.0,
            smoothing: RunSmoothing::default(),
        })
    }
}

/// A run being smoothed.
struct Smooth {
    run: Box<Run>,
    smoothing: RunSmoothing,
}

impl RunningJob for Smooth {
    fn advance(
        &mut self,
        _worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let (run, smoothing) = (&self.run, &mut self.smoothing);
        let mut wrong = None;
        let is_more = slice(clock, || {
            let more = smoothing.advance(run, AT_A_TIME);
            more.unwrap_or_else(|cause| {
                wrong = Some(cause.to_string());
                false
            })
        });
        if let Some(cause) = wrong {
            return Err(cause);
        }
        if is_more {
            let share = smoothing.done() as f32 / run.steps.len() as f32;
            emit(JobEvent::Progress(share, "Smoothing the run".to_owned()));
            return Ok(Advance::More);
        }
        let estimates = std::mem::take(smoothing).into_estimates();
        let places = run.steps.iter().zip(&estimates).map(|(step, estimate)| {
            let place = estimate.position();
            (step.time, place.north, place.east)
        });
        emit(JobEvent::Smoothed(places.collect()));
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}
