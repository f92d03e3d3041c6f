//! The plan that is written down, being read by a worker: the page links no reader of TOML.

use pilotage_core::camera::CameraModel;
use pilotage_core::mission::Mission;
use pilotage_jobs::{Job, JobEvent, JobId, ReadStudyPlan, ReadStudyPlanOrder};

use super::draft::StudyDraft;
use crate::feature::FeatureContext;

/// The text that a worker is reading, if one is.
#[derive(Default)]
pub struct PlanReading {
    asked: Option<(JobId, String)>,
    /// Mission that was open when a text that flies missions was read last.
    with: Option<Box<Mission>>,
    /// Camera of the flight that was open then: that of a mission without one, as in its predictions.
    camera: Option<CameraModel>,
}

impl PlanReading {
    /// Has the text of a draft read, if it is not; what was asked of another text no longer matters.
    pub fn ask(&mut self, draft: &mut StudyDraft, context: &mut FeatureContext<'_>) {
        let open: &Mission = &context.documents.mission;
        let flown = context.documents.flight.measured.as_ref();
        let camera = flown.map(|flight| &flight.camera);
        let is_same = self.with.as_deref() == Some(open) && self.camera.as_ref() == camera;
        if draft.flies_missions() && !is_same {
            self.with = Some(Box::new(open.clone()));
            self.camera = camera.cloned();
            draft.read_again();
            if let Some((before, _)) = self.asked.take() {
                context.cancel(before);
            }
        }
        let Some(text) = draft.unread() else { return };
        if self.asked.as_ref().is_some_and(|(_, asked)| asked == text) {
            return;
        }
        let text = text.to_owned();
        let mut open = self.with.clone().filter(|_| draft.flies_missions());
        if let Some(mission) = &mut open {
            mission.camera = mission.camera.take().or(self.camera.clone());
        }
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
    pub fn receive(
        &mut self,
        id: JobId,
        event: &JobEvent,
        draft: &mut StudyDraft,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        let asked = self.asked.as_ref();
        if asked.is_none_or(|(job, _)| *job != id) {
            return false;
        }
        let read = match event {
            JobEvent::Figures(_) => event.read_figures::<ReadStudyPlan>(),
            JobEvent::Failed(why) => Err(why.clone()),
            JobEvent::Progress(..) | JobEvent::Finished | JobEvent::Cancelled => return true,
            _ => return false,
        };
        context.wait_no_more(id);
        let asked = self.asked.take();
        if asked.is_some_and(|(_, text)| draft.unread() == Some(text.as_str())) {
            draft.take(read);
        }
        true
    }
}
