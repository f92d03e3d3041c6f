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
