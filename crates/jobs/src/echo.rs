//! An order that says what it was told.

use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole};
use super::running::once;
use super::{JobEvent, RunningJob, WorkerState};

/// Words to be said again: event `Remark`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EchoOrder(pub String);

impl Order for EchoOrder {
    const URGENCY: Urgency = Urgency::Asked;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |_, emit| {
            emit(JobEvent::Remark(self.0));
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{InlineWorkers, Job};

    #[test]
    fn what_is_said_comes_back() {
        let mut workers = InlineWorkers::new();
        let id = workers.start(Job::Echo(EchoOrder("hello".into())));
        workers.finish_jobs();
        let remark = JobEvent::Remark("hello".into());
        assert_eq!(workers.events(), [(id, remark), (id, JobEvent::Finished)]);
    }
}
