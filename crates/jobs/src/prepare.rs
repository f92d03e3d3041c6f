//! Preparation of a large map, made ahead a piece after the other: wide views of it are quick afterwards.

use std::sync::Arc;

use pilotage_core::imagery::Imagery;

use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole, keys_of};
use super::running::SLICE;
use super::{Advance, JobEvent, MapSource, RunningJob, WorkerState};

/// A map being prepared.
pub struct PrepareMap {
    source: MapSource,
    map: Option<Arc<dyn Imagery>>,
}

impl PrepareMap {
    /// Nothing done yet.
    pub fn new(source: MapSource) -> Self {
        Self { source, map: None }
    }
}

impl RunningJob for PrepareMap {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let map = match &self.map {
            Some(map) => map.clone(),
            None => self.map.insert(worker.map(&self.source)?).clone(),
        };
        let begun = clock();
        let (done, all) = loop {
            let (done, all) = map.prepare(1);
            if done >= all || clock() - begun > SLICE {
                break (done, all);
            }
        };
        for problem in worker.new_problems(&self.source) {
            emit(JobEvent::Remark(problem));
        }
        if done >= all {
            emit(JobEvent::Finished);
            return Ok(Advance::Done);
        }
        let words = format!("Making an overview of {}", map.name());
        emit(JobEvent::Progress(done as f32 / all as f32, words));
        Ok(Advance::More)
    }
}

/// Preparation of what wide views of a large map need: events `Progress`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PrepareMapOrder(pub MapSource);

impl Order for PrepareMapOrder {
    const URGENCY: Urgency = Urgency::Ahead;

    fn role(&self) -> WorkerRole {
        WorkerRole::Map
    }

    fn files(&self) -> Vec<&str> {
        keys_of(None, Some(&self.0))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(PrepareMap::new(self.0))
    }
}
