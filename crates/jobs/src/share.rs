//! Shares of an order that several workers do together.

use serde::{Deserialize, Serialize};

use super::order::{Order, Reads, Urgency, WorkerRole};
use super::{MapSource, RunningJob, Share, WorkerState};

/// Order of which a worker can do a share.
pub trait Shareable: Order {
    /// Makes a share of it ready to advance.
    fn begin_share(self, share: Share) -> Box<dyn RunningJob>;
}

/// Share of an order: it needs what the whole needs, and has its own worker.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShareOrder<O>(pub Box<O>, pub Share);

impl<O: Shareable> Order for ShareOrder<O> {
    const URGENCY: Urgency = O::URGENCY;

    fn role(&self) -> WorkerRole {
        WorkerRole::ALL[self.1.part % WorkerRole::ALL.len()]
    }

    fn files(&self) -> Vec<&str> {
        self.0.files()
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        self.0.reads()
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        self.0.begin_share(self.1)
    }
}
