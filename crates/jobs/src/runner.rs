//! The jobs of one worker.

use super::order::Urgency;
use super::programs::Begin;
use super::{Abilities, Advance, JobEvent, JobId, Reply, Request, RunningJob, WorkerState};

/// Least time between two words on the progress of a job, milliseconds. The page is painted anew for
/// each, which takes from the time of the job where no graphics card does it.
const PROGRESS_EVERY: f64 = 500.0;

struct Entry {
    id: JobId,
    urgency: Urgency,
    job: Box<dyn RunningJob>,
    /// When its progress was told last.
    told: Option<f64>,
    /// Whether it keeps its place without working.
    is_held: bool,
}

impl Entry {
    /// Whether to tell this event now: progress only now and then.
    fn is_told(told: &mut Option<f64>, event: &JobEvent, now: f64) -> bool {
        if !matches!(event, JobEvent::Progress(..)) {
            return true;
        }
        let is_due = told.is_none_or(|told| now - told >= PROGRESS_EVERY);
        if is_due {
            *told = Some(now);
        }
        is_due
    }
}

/// Takes requests and works on the most urgent job that is not held, the eldest among equals, a slice
/// at a time.
pub struct JobRunner {
    worker: WorkerState,
    begin: Begin,
    entries: Vec<Entry>,
}

impl JobRunner {
    /// A runner without jobs for a program that can do this.
    pub fn new(abilities: Abilities) -> Self {
        Self {
            worker: WorkerState::new(abilities.opens),
            begin: abilities.begin,
            entries: Vec::new(),
        }
    }

    /// Store that the jobs share.
    pub fn state_mut(&mut self) -> &mut WorkerState {
        &mut self.worker
    }

    /// Whether a slice would do anything.
    pub fn busy(&self) -> bool {
        self.entries.iter().any(|e| !e.is_held)
    }

    /// Takes a request; what it answers at once is emitted.
    pub fn receive(&mut self, request: Request, emit: &mut dyn FnMut(Reply)) {
        match request {
            Request::Start(id, job) => {
                let urgency = job.urgency();
                if urgency == Urgency::Files {
                    // What was to be let go of was said before these files were known.
                    self.entries.retain(|e| e.urgency != Urgency::Leaving);
                }
                let job = (self.begin)(job, &mut self.worker);
                let place = self.entries.partition_point(|e| e.urgency <= urgency);
                let entry = Entry {
                    id,
                    urgency,
                    job,
                    told: None,
                    is_held: false,
                };
                self.entries.insert(place, entry);
            }
            Request::Cancel(id) => {
                let before = self.entries.len();
                self.entries.retain(|e| e.id != id);
                if self.entries.len() < before {
                    emit(Reply::Event(id, JobEvent::Cancelled));
                }
            }
            Request::Hold(id, is_held) => {
                for entry in self.entries.iter_mut().filter(|e| e.id == id) {
                    entry.is_held = is_held;
                }
            }
            Request::Ping => emit(Reply::Alive),
        }
    }

    /// Works for one slice; false once there is nothing to do.
    pub fn turn(&mut self, clock: &dyn Fn() -> f64, emit: &mut dyn FnMut(Reply)) -> bool {
        let Some(place) = self.entries.iter().position(|e| !e.is_held) else {
            return false;
        };
        let entry = &mut self.entries[place];
        let (id, told) = (entry.id, &mut entry.told);
        let mut tell = |event| {
            if Entry::is_told(told, &event, clock()) {
                emit(Reply::Event(id, as_sentence(event)));
            }
        };
        let advance = entry.job.advance(&mut self.worker, clock, &mut tell);
        if let Err(why) = &advance {
            tell(JobEvent::Failed(why.clone()));
        }
        if advance != Ok(Advance::More) {
            self.entries.remove(place);
        }
        self.busy()
    }
}

/// Ends the reason of a failure with a full stop: it is shown beside other sentences.
fn as_sentence(mut event: JobEvent) -> JobEvent {
    if let JobEvent::Failed(why) | JobEvent::CannotNavigate(why) = &mut event
        && !why.trim_end().ends_with(['.', '!', '?'])
    {
        *why = format!("{}.", why.trim_end());
    }
    event
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Job, LetGoOrder, ProvideOrder};

    #[test]
    fn files_that_come_while_others_wait_to_be_let_go_stay() {
        let mut runner = JobRunner::new(Abilities::WHOLE);
        let mut ignore = |_: Reply| {};
        let provide = |key: &str| {
            Job::Provide(ProvideOrder {
                key: key.to_owned(),
                files: Vec::new(),
            })
        };
        let let_go = Job::LetGo(LetGoOrder { keys: Vec::new() });
        for (id, job) in [provide("early"), let_go.clone(), provide("late")]
            .into_iter()
            .enumerate()
        {
            runner.receive(Request::Start(id as u64, job), &mut ignore);
        }
        while runner.turn(&|| 0.0, &mut ignore) {}
        assert!(runner.state_mut().files("late").is_ok());
        runner.receive(Request::Start(9, let_go), &mut ignore);
        while runner.turn(&|| 0.0, &mut ignore) {}
        assert!(runner.state_mut().files("late").is_err());
    }

    #[test]
    fn progress_is_told_now_and_then_and_all_else_at_once() {
        let mut told = None;
        let mut at = |event: JobEvent, now| Entry::is_told(&mut told, &event, now);
        let progress = || JobEvent::Progress(0.5, String::new());
        assert!(at(progress(), 1000.0), "the first");
        assert!(!at(progress(), 1030.0));
        assert!(at(JobEvent::Finished, 1040.0));
        assert!(!at(progress(), 1499.0));
        assert!(at(progress(), 1501.0));
    }
}
