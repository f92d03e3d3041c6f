//! A job that is under way.

use super::{Job, JobEvent, Workshop};

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

/// Whether a job has more to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Advance {
    /// Call again.
    More,
    /// The last event was sent.
    Done,
}

/// A job as a state machine: whoever owns it calls [`RunningJob::advance`] until it is done, and
/// drops it to cancel it.
pub trait RunningJob {
    /// Works for about a slice (25 ms by `clock`, milliseconds) and emits what came of it.
    ///
    /// # Errors
    /// Why it cannot go on, in words; its owner tells them as the job's last event.
    fn advance(
        &mut self,
        workshop: &mut Workshop,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String>;
}

impl Workshop {
    /// Makes a job ready to advance.
    pub fn start(&mut self, job: Job) -> Box<dyn RunningJob> {
        (self.abilities.begin)(self, job)
    }
}

/// A job that is one piece of work, done in one call.
pub struct Once<F>(pub Option<F>);

impl<F> RunningJob for Once<F>
where
    F: FnOnce(&mut Workshop, &mut dyn FnMut(JobEvent)) -> Result<(), String>,
{
    fn advance(
        &mut self,
        workshop: &mut Workshop,
        _clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        if let Some(work) = self.0.take() {
            work(workshop, emit)?;
            emit(JobEvent::Finished);
        }
        Ok(Advance::Done)
    }
}
