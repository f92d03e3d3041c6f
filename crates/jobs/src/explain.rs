//! Past steps looked at again: what explains what a detector did.

use std::sync::Arc;

use pilotage_core::flight::{Flight, FrameSource as _};
use pilotage_core::imagery::Imagery;
use pilotage_core::landmark::{Landmark, Refusal};
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{StepReport, explain, explain_cascade};
use pilotage_core::raster::Picture;

use serde::{Deserialize, Serialize};

use super::order::{Order, Reads, Urgency, WorkerRole, around, keys_of};
use super::running::once;
use super::{
    DetectorSearch, ExplainedBy, FlightSource, JobEvent, MapSource, MatchPictures, RunningJob,
    WorkerState,
};

/// Match to be explained by pictures: event `Match`, or `Detector` of one by a trained detector.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExplainOrder {
    /// Detector by which the landmark is looked for.
    pub by: ExplainedBy,
    /// The flight.
    pub flight: FlightSource,
    /// The map.
    pub map: MapSource,
    /// The mission.
    pub mission: Mission,
    /// The step whose frame is meant.
    pub step: Box<StepReport>,
    /// The landmark.
    pub landmark: u32,
}

impl Order for ExplainOrder {
    const URGENCY: Urgency = Urgency::Asked;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn files(&self) -> Vec<&str> {
        keys_of(Some(&self.flight), Some(&self.map))
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        let landmark = self.mission.landmark(self.landmark);
        let areas = landmark.map(|l| around(&l.bounds)).into_iter().collect();
        Some((&self.map, Reads::Areas(areas)))
    }

    fn is_small(&self) -> bool {
        self.flight.is_small() && self.map.is_small()
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |worker, emit| {
            emit(match self.by {
                ExplainedBy::Template => JobEvent::Match(Box::new(self.match_pictures(worker)?)),
                ExplainedBy::Cascade => JobEvent::Detector(Box::new(self.detector_search(worker))),
            });
            Ok(())
        })
    }
}

impl ExplainOrder {
    /// Runs `look` on the step's picture and returns its answer, or in words why there is none.
    fn again<R>(
        &self,
        worker: &mut WorkerState,
        look: impl FnOnce(&Flight, Arc<dyn Imagery>, &Landmark, &Picture) -> Option<Result<R, Refusal>>,
    ) -> Result<R, String> {
        let map = worker.map(&self.map)?;
        let open = worker.flight(&self.flight)?;
        let mut open = open.borrow_mut();
        let index = self
            .step
            .frame
            .as_ref()
            .ok_or("this step has no camera picture")?
            .index;
        let picture = open.frames.picture(index).map_err(|e| e.to_string())?;
        let marked = self
            .mission
            .landmark(self.landmark)
            .ok_or("the landmark is no longer in the mission")?;
        let flown = self.mission.flown(&open.flight);
        look(&flown, map, marked, &picture)
            .ok_or("the landmark was not looked for in this picture")?
            .map_err(|refusal| format!("{}: {}", marked.name, refusal.reason()))
    }

    /// The pictures that explain what the template detector did.
    fn match_pictures(&self, worker: &mut WorkerState) -> Result<MatchPictures, String> {
        let settings = &self.mission.navigator;
        let evidence = self.again(worker, |flight, map, marked, picture| {
            explain(flight, map, settings, marked, &self.step, picture)
        })?;
        let mut peaks = evidence.peaks.into_iter();
        Ok(MatchPictures {
            time: self.step.time,
            landmark: self.landmark,
            patch: evidence.patch,
            rectified: evidence.rectified,
            surface: evidence.surface,
            peak: peaks.next(),
            second: peaks.next(),
            gsd: evidence.gsd,
        })
    }

    /// Search of the landmark's trained detector in the step's picture.
    fn detector_search(&self, worker: &mut WorkerState) -> DetectorSearch {
        let settings = &self.mission.navigator;
        let found = self.again(worker, |flight, map, marked, picture| {
            explain_cascade(flight, map.as_ref(), settings, marked, &self.step, picture)
        });
        DetectorSearch {
            time: self.step.time,
            landmark: self.landmark,
            found,
        }
    }
}
