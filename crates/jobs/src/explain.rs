//! Past steps looked at again: what explains what a detector did.

use std::sync::Arc;

use pilotage_core::flight::{Flight, FrameSource as _};
use pilotage_core::imagery::Imagery;
use pilotage_core::landmark::{Landmark, Refusal};
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{StepReport, explain, explain_cascade};
use pilotage_core::raster::Picture;

use super::{
    DetectorSearch, ExplainedBy, FlightSource, Job, JobEvent, MapSource, MatchPictures, Workshop,
};

/// Answer to a job that explains a match: its pictures, or the search of the trained detector.
pub fn explained(workshop: &mut Workshop, job: &Job) -> Result<JobEvent, String> {
    let Job::ExplainMatch {
        by,
        flight,
        map,
        mission,
        step,
        landmark,
    } = job
    else {
        return Err("this is no question about a match".to_owned());
    };
    let look = PastLook {
        flight,
        map,
        mission,
        step,
        landmark: *landmark,
    };
    Ok(match by {
        ExplainedBy::Template => JobEvent::Match(Box::new(look.match_pictures(workshop)?)),
        ExplainedBy::Cascade => JobEvent::Detector(Box::new(look.detector_search(workshop))),
    })
}

/// Step that is looked at again, and its landmark.
struct PastLook<'a> {
    flight: &'a FlightSource,
    map: &'a MapSource,
    mission: &'a Mission,
    step: &'a StepReport,
    landmark: u32,
}

impl PastLook<'_> {
    /// Runs `look` on the step's picture and returns its answer, or in words why there is none.
    fn again<R>(
        &self,
        workshop: &mut Workshop,
        look: impl FnOnce(&Flight, Arc<dyn Imagery>, &Landmark, &Picture) -> Option<Result<R, Refusal>>,
    ) -> Result<R, String> {
        let map = workshop.map(self.map)?;
        let open = workshop.flight(self.flight)?;
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
    fn match_pictures(&self, workshop: &mut Workshop) -> Result<MatchPictures, String> {
        let settings = &self.mission.navigator;
        let evidence = self.again(workshop, |flight, map, marked, picture| {
            explain(flight, map, settings, marked, self.step, picture)
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
    fn detector_search(&self, workshop: &mut Workshop) -> DetectorSearch {
        let settings = &self.mission.navigator;
        let found = self.again(workshop, |flight, map, marked, picture| {
            explain_cascade(flight, map.as_ref(), settings, marked, self.step, picture)
        });
        DetectorSearch {
            time: self.step.time,
            landmark: self.landmark,
            found,
        }
    }
}
