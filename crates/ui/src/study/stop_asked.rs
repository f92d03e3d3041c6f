//! The rule of a plan to stop early, asked of a worker while the study is flown: the page sums nothing up itself.

use pilotage_jobs::{JobEvent, JobId};
use pilotage_study::StudyPlan;

use crate::feature::FeatureContext;

/// Questions to the rule, and its answer.
#[derive(Debug, Default)]
pub struct StopAsked {
    /// Question under way.
    job: Option<JobId>,
    /// Draws that it was asked about.
    about: u64,
    enough: Option<u64>,
}

impl StopAsked {
    /// Draws to ask it about now that so many are whole; `None` while a question is under way, or where the rule has
    /// nothing new to judge.
    pub fn due(&self, plan: &StudyPlan, whole: u64) -> Option<u64> {
        let every = plan.stop.as_ref()?.every.max(1);
        let draws = whole / every * every;
        let is_free = self.job.is_none() && self.enough.is_none();
        (is_free && draws > self.about && draws < plan.draws).then_some(draws)
    }

    /// Remembers a question about so many draws.
    pub fn asked(&mut self, job: JobId, draws: u64) {
        (self.job, self.about) = (Some(job), draws);
    }

    /// Takes what a worker says: draws that are enough, if they are. `None` if it is about something else.
    pub fn receive(&mut self, id: JobId, event: &JobEvent) -> Option<Result<Option<u64>, String>> {
        if self.job != Some(id) {
            return None;
        }
        if event.is_last() {
            self.job = None;
        }
        match event {
            JobEvent::Figures(_) => {
                let said = event.read_figures::<Option<u64>>();
                self.enough = said.as_ref().ok().copied().flatten();
                Some(said)
            }
            JobEvent::Failed(why) => Some(Err(why.clone())),
            JobEvent::Progress(..) | JobEvent::Finished | JobEvent::Cancelled => Some(Ok(None)),
            _ => None,
        }
    }

    /// Whether a question is under way.
    pub fn is_under_way(&self) -> bool {
        self.job.is_some()
    }

    /// Draws that were enough.
    pub fn enough(&self) -> Option<u64> {
        self.enough
    }

    /// Gives a question up.
    pub fn forget(&mut self, context: &mut FeatureContext<'_>) {
        if let Some(job) = self.job.take() {
            context.cancel(job);
        }
    }
}
