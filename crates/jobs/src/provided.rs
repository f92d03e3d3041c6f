//! Files that jobs name, given to workers and taken back.

use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole};
use super::running::once;
use super::{FileContent, RunningJob, WorkerState};

/// Files to be kept under a key; sent to every worker, again after a restart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProvideOrder {
    /// Key that later jobs name.
    pub key: String,
    /// Path and content of each.
    pub files: Vec<(String, FileContent)>,
}

impl Order for ProvideOrder {
    const URGENCY: Urgency = Urgency::Files;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn begin(self, worker: &mut WorkerState) -> Box<dyn RunningJob> {
        worker.provide(self.key, &self.files);
        once(|_, _| Ok(()))
    }
}

/// Provided files to be let go of, with everything that was made of them, once nothing else is to be done.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LetGoOrder {
    /// Keys of the files that stay.
    pub keys: Vec<String>,
}

impl Order for LetGoOrder {
    const URGENCY: Urgency = Urgency::Leaving;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |worker, _| {
            worker.let_go(&self.keys.into_iter().collect());
            Ok(())
        })
    }
}
