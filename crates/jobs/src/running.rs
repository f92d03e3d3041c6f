//! Jobs in slices, and jobs that are one piece of work.

use super::{Advance, JobEvent, RunningJob, WorkerState};

/// Longest time that a slice of work should take, milliseconds.
pub const SLICE: f64 = 25.0;

/// Takes steps for about a slice of `clock` (milliseconds), or until one says that it was the last; whether
/// there are more.
pub fn slice(clock: &dyn Fn() -> f64, mut step: impl FnMut() -> bool) -> bool {
    let begun = clock();
    let mut more = true;
    while more && clock() - begun < SLICE {
        more = step();
    }
    more
}

/// A job that is one piece of work, done in one call.
struct Once<F>(Option<F>);

impl<F> RunningJob for Once<F>
where
    F: FnOnce(&mut WorkerState, &mut dyn FnMut(JobEvent)) -> Result<(), String>,
{
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        _clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        if let Some(work) = self.0.take() {
            work(worker, emit)?;
            emit(JobEvent::Finished);
        }
        Ok(Advance::Done)
    }
}

/// A job that is one piece of work.
pub fn once<F>(work: F) -> Box<dyn RunningJob>
where
    F: FnOnce(&mut WorkerState, &mut dyn FnMut(JobEvent)) -> Result<(), String> + 'static,
{
    Box::new(Once(Some(work)))
}

/// Events of an order that is worked on to its end, the last of them the first that says so.
#[cfg(test)]
pub fn finished(order: impl super::Order) -> Vec<JobEvent> {
    let mut worker = WorkerState::new(super::Abilities::WHOLE.opens);
    let mut job = order.begin(&mut worker);
    let mut events = Vec::new();
    loop {
        match job.advance(&mut worker, &|| 0.0, &mut |event| events.push(event)) {
            Ok(Advance::More) => {}
            Ok(Advance::Done) => return events,
            Err(why) => {
                events.push(JobEvent::Failed(why));
                return events;
            }
        }
    }
}

/// Figures that an order tells.
#[cfg(test)]
pub fn figures<T: serde::de::DeserializeOwned>(order: impl super::Order) -> T {
    let events = finished(order);
    let told = events
        .iter()
        .find(|event| matches!(event, JobEvent::Figures(_)));
    let told = told.unwrap_or_else(|| panic!("no figures, but {:?}", events.last()));
    told.read_figures().expect("figures of that type")
}
