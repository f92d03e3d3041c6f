//! Provided files looked through: their kind, and the places that they name.

use pilotage_core::frames::Geodetic;
use serde::{Deserialize, Serialize};

use super::opening::{look_through, places};
use super::order::{Order, Urgency, WorkerRole};
use super::running::once;
use super::{JobEvent, RunningJob, WorkerState};

/// Provided files whose kind is asked for: event `Opened`, or `Failed`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OpenOrder {
    /// Key of the files.
    pub key: String,
    /// Origin of the world frame that is open; a map far from it gets a frame of its own.
    pub near: Option<Geodetic>,
    /// Origin of the mission's world, in which routes and landmarks are placed.
    pub origin: Geodetic,
}

impl Order for OpenOrder {
    const URGENCY: Urgency = Urgency::First;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn files(&self) -> Vec<&str> {
        vec![&self.key]
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |worker, emit| {
            let files = worker.files(&self.key)?;
            let opened = look_through(self.key, &files, self.near, self.origin)?;
            emit(JobEvent::Opened(Box::new(opened)));
            Ok(())
        })
    }
}

/// File of routes and landmarks whose named places are asked for: event `Places`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReadPlacesOrder {
    /// Key of the files.
    pub key: String,
}

impl Order for ReadPlacesOrder {
    const URGENCY: Urgency = Urgency::First;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn files(&self) -> Vec<&str> {
        vec![&self.key]
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |worker, emit| {
            let files = worker.files(&self.key)?;
            emit(JobEvent::Places(places(files.as_ref())?));
            Ok(())
        })
    }
}
