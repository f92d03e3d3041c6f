//! Rehearsal of a landmark for which nobody waits yet.

use serde::{Deserialize, Serialize};

use super::order::{Order, Reads, Urgency, WorkerRole};
use super::{AssessmentOrder, MapSource, RunningJob, WorkerState};

/// Landmark to be measured behind everything that people wait for: event `Assessment`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AssessAheadOrder(pub Box<AssessmentOrder>);

impl Order for AssessAheadOrder {
    const URGENCY: Urgency = Urgency::Slow;

    fn role(&self) -> WorkerRole {
        self.0.role()
    }

    fn files(&self) -> Vec<&str> {
        self.0.files()
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        self.0.reads()
    }

    fn begin(self, worker: &mut WorkerState) -> Box<dyn RunningJob> {
        self.0.begin(worker)
    }
}
