//! Messages between page and worker, beside jobs and events.

use serde::{Deserialize, Serialize};

use super::JobEvent;
use crate::Job;

/// Number of a job, unique within a page.
pub type JobId = u64;

/// Page to worker.
#[expect(
    clippy::large_enum_variant,
    reason = "a request lives for one message; nobody keeps a list of them"
)]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Request {
    /// Begin a job.
    Start(JobId, Job),
    /// Stop a job; its last event is `Cancelled`.
    Cancel(JobId),
    /// Let a job keep its place without working, or work on.
    Hold(JobId, bool),
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
