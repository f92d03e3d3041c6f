//! The plan that is written down, being read by a worker: the page links no reader of TOML.

use pilotage_core::mission::Mission;
use pilotage_jobs::{Job, JobEvent, JobId, ReadStudyPlanOrder};
use pilotage_study::StudyPlanParts;

use super::draft::StudyDraft;
use crate::feature::FeatureContext;

/// The text that a worker is reading, if one is.
#[derive(Default)]
pub struct PlanReading {
    asked: Option<(JobId, String)>,
    /// Mission that was open when a text that flies missions was read last.
    with: Option<Box<Mission>>,
}

impl PlanReading {
    /// Has the text of a draft read, if it is not; what was asked of another text no longer matters.
    pub fn ask(&mut self, draft: &mut StudyDraft, context: &mut FeatureContext<'_>) {
        let open: &Mission = &context.documents.mission;
        if draft.flies_missions() && self.with.as_deref() != Some(open) {
            self.with = Some(Box::new(open.clone()));
            draft.read_again();
            self.asked = None;
        }
        let Some(text) = draft.unread() else { return };
        if self.asked.as_ref().is_some_and(|(_, asked)| asked == text) {
            return;
        }
        let text = text.to_owned();
        let open = self.with.clone().filter(|_| draft.flies_missions());
        let job = Job::ReadStudyPlan(ReadStudyPlanOrder {
            text: text.clone(),
            open,
        });
        let asked = (context.start(job), text);
        if let Some((before, _)) = self.asked.replace(asked) {
            context.cancel(before);
        }
    }

    /// Takes what a worker says; false if it is about something else.
    pub fn receive(&mut self, id: JobId, event: &JobEvent, draft: &mut StudyDraft) -> bool {
        let asked = self.asked.as_ref();
        if asked.is_none_or(|(job, _)| *job != id) {
            return false;
        }
        let read = match event {
            JobEvent::Figures(_) => event.read_figures::<StudyPlanParts>().map(Into::into),
            JobEvent::Failed(why) => Err(why.clone()),
            _ => return true,
        };
        let asked = self.asked.take();
        if asked.is_some_and(|(_, text)| draft.unread() == Some(text.as_str())) {
            draft.take(read);
        }
        true
    }
}
