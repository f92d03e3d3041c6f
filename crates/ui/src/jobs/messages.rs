//! What page and worker say to each other, beside jobs and events.

use serde::{Deserialize, Serialize};

use super::{Job, JobEvent, JobId};

/// Page to worker.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Request {
    /// Begin a job.
    Start(JobId, Job),
    /// Stop a job; its last event is `Cancelled`.
    Cancel(JobId),
    /// Answer with [`Reply::Alive`].
    Ping,
}

/// Worker to page.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Reply {
    /// Something about a job.
    Event(JobId, JobEvent),
    /// The worker listens.
    Alive,
}
