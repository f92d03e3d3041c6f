//! A camera picture of a flight, once more.

use serde::{Deserialize, Serialize};

use super::order::{Order, Role, Urgency, keys_of};
use super::running::once;
use super::{FlightSource, JobEvent, RunningJob, WorkerState};

/// Camera picture of a flight that the page let go of: event `FramePicture`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FramePictureOrder {
    /// The flight.
    pub flight: FlightSource,
    /// Index of the frame.
    pub index: usize,
}

impl Order for FramePictureOrder {
    const URGENCY: Urgency = Urgency::First;

    /// The worker that flies has the flight open.
    fn role(&self) -> Role {
        Role::Flight
    }

    fn files(&self) -> Vec<&str> {
        keys_of(Some(&self.flight), None)
    }

    fn is_small(&self) -> bool {
        self.flight.is_built_in()
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |worker, emit| {
            let open = worker.flight(&self.flight)?;
            let encoded = open.borrow_mut().frames.kept(self.index);
            let encoded = encoded.map_err(|cause| cause.to_string())?.to_vec();
            let index = self.index;
            emit(JobEvent::FramePicture { index, encoded });
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FlyOrder, InlineWorkers, Job, SimulationOptions};

    fn pictures(events: Vec<(u64, JobEvent)>) -> Vec<(usize, Vec<u8>)> {
        let of = |(_, event)| match event {
            JobEvent::FramePicture { index, encoded } => Some((index, encoded)),
            _ => None,
        };
        events.into_iter().filter_map(of).collect()
    }

    #[test]
    fn a_picture_that_is_asked_for_once_more_is_the_one_that_was_told() {
        let demo = SimulationOptions::demo();
        let (map, flight) = (demo.map(), FlightSource::Simulated(demo));
        let mut workers = InlineWorkers::new();
        let id = workers.start(Job::Fly(FlyOrder {
            flight: flight.clone(),
            map,
            mission: None,
        }));
        let mut told = Vec::new();
        while told.len() < 3 {
            told.extend(pictures(workers.events()));
        }
        workers.cancel(id);
        workers.events();
        let index = told[1].0;
        workers.start(Job::FramePicture(FramePictureOrder { flight, index }));
        workers.finish_jobs();
        assert_eq!(pictures(workers.events()), [told[1].clone()]);
    }

    #[test]
    fn a_picture_that_is_not_there_is_refused_in_words() {
        let flight = FlightSource::Simulated(SimulationOptions::demo());
        let mut workers = InlineWorkers::new();
        let index = 1_000_000;
        workers.start(Job::FramePicture(FramePictureOrder { flight, index }));
        workers.finish_jobs();
        let events = workers.events();
        assert!(
            matches!(&events[..], [(_, JobEvent::Failed(_))]),
            "{events:?}"
        );
    }
}
