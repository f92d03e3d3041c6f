//! A host whose jobs are really done, on the calling thread.

use std::cell::Cell;
use std::collections::BTreeSet;

use pilotage_jobs::{InlineWorkers, Job, JobEvent, JobId, LetGoOrder};
use pilotage_ui::host::{Host, OpenedFile};
use pilotage_ui::job_owners::{JobOwner, JobOwners};

/// Runs jobs a slice at a time whenever the app asks for events, with a clock of its own; stores nothing.
#[derive(Default)]
pub struct InlineHost {
    workers: InlineWorkers,
    owners: JobOwners,
    clock: Cell<f64>,
}

impl InlineHost {
    /// Moves the clock forward by milliseconds.
    pub fn pass_time(&mut self, milliseconds: f64) {
        self.clock.set(self.clock.get() + milliseconds);
    }
}

impl Host for InlineHost {
    fn now(&self) -> f64 {
        self.clock.get()
    }

    fn owners(&mut self) -> &mut JobOwners {
        &mut self.owners
    }

    fn begin(&mut self, job: Job) -> JobId {
        self.workers.start(job)
    }

    fn cancel(&mut self, job: JobId) {
        self.workers.cancel(job);
    }

    fn hold(&mut self, job: JobId, is_held: bool) {
        self.workers.hold(job, is_held);
    }

    fn let_go(&mut self, in_use: &BTreeSet<String>) {
        let keys = in_use.iter().cloned().collect();
        self.start(JobOwner::Files, Job::LetGo(LetGoOrder { keys }));
    }

    fn events(&mut self) -> Vec<(JobId, JobEvent)> {
        self.workers.events()
    }

    fn opened(&mut self) -> Vec<Vec<OpenedFile>> {
        Vec::new()
    }

    fn ask_for_files(&mut self) {}

    fn save_file(&mut self, _name: &str, _bytes: &[u8]) {}

    fn store(&mut self, _key: &str, _bytes: &[u8]) {}

    fn recall(&self, _key: &str) -> Option<Vec<u8>> {
        None
    }
}
