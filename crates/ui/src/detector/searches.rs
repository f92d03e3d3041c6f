//! Searches that trained detectors make once more, to be looked at: asked for, taken.

use pilotage_jobs::{DetectorSearch, ExplainedBy, JobEvent, JobId};

use crate::documents::Documents;
use crate::feature::FeatureContext;

/// Search in a run.
#[derive(Clone, Copy, PartialEq)]
struct SearchKey {
    /// Generation of the run.
    run: u64,
    /// Time of the step, seconds in the flight's time base.
    time: f64,
    landmark: u32,
}

/// Searches that trained detectors make once more.
#[derive(Default)]
pub(super) struct SearchRequests {
    /// Job under way, and the search that it is about.
    asked: Option<(JobId, SearchKey)>,
    /// Search that was found last, and the run that it is of.
    found: Option<(u64, DetectorSearch)>,
}

impl SearchRequests {
    /// Search that was found last, if it is of the run that is open.
    pub fn found(&self, documents: &Documents) -> Option<&DetectorSearch> {
        let (run, search) = self.found.as_ref()?;
        (*run == documents.run_generation).then_some(search)
    }

    /// Asks what the trained detector of a landmark saw and did in the step at `time`, once.
    pub fn ask(&mut self, time: f64, landmark: u32, context: &mut FeatureContext<'_>) {
        let documents = &*context.documents;
        let key = SearchKey {
            run: documents.run_generation,
            time,
            landmark,
        };
        let is_it = |s: &DetectorSearch| s.time == time && s.landmark == landmark;
        let is_known = self.found(documents).is_some_and(is_it);
        let is_asked = self.asked.is_some_and(|(_, asked)| asked == key);
        // One question at a time: while the flight plays, the latest search is asked for next.
        let is_busy = self.asked.is_some() && context.playback.playing;
        if is_known || is_asked || is_busy {
            return;
        }
        let Some(job) = documents.explanation(ExplainedBy::Cascade, time, landmark) else {
            return;
        };
        self.stop(context);
        self.asked = Some((context.start(job), key));
    }

    /// Whether a job is the one under way.
    pub fn is_of(&self, job: JobId) -> bool {
        self.asked.is_some_and(|(asked, _)| asked == job)
    }

    /// Takes an event of the job under way.
    pub fn take(&mut self, event: JobEvent) {
        let Some((_, key)) = self.asked else { return };
        let is_last = event.is_last();
        match event {
            JobEvent::Detector(search) => self.found = Some((key.run, *search)),
            JobEvent::Failed(why) => {
                let search = DetectorSearch {
                    time: key.time,
                    landmark: key.landmark,
                    found: Err(why),
                };
                self.found = Some((key.run, search));
            }
            _ => {}
        }
        if is_last {
            self.asked = None;
        }
    }

    /// Stops the job under way.
    pub fn stop(&mut self, context: &mut FeatureContext<'_>) {
        if let Some((job, _)) = self.asked.take() {
            context.cancel(job);
        }
    }
}
