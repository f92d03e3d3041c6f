//! Explanations of landmarks in steps of the run, asked of the workers one at a time.

use pilotage_jobs::{ExplainOrder, ExplainedBy, Job, JobEvent, JobId};

use crate::documents::Documents;
use crate::feature::FeatureContext;
use crate::views::ExplainedStep;

/// Answer that was `found` with what it is of, if it is about the run that is open.
pub fn of_run<'a, T>(
    found: Option<&'a (ExplainedStep, T)>,
    documents: &Documents,
) -> Option<(ExplainedStep, &'a T)> {
    let (step, answer) = found?;
    (!documents.run.is_before(step.run)).then_some((*step, answer))
}

/// Questions of one kind: the one under way, and the one answered last.
#[derive(Debug, Default)]
pub struct Explanations {
    asked: Option<(JobId, ExplainedStep)>,
    answered: Option<ExplainedStep>,
}

impl Explanations {
    /// Asks for an explanation of a landmark in the step at `time`, once.
    pub fn ask(
        &mut self,
        by: ExplainedBy,
        (time, landmark): (f64, u32),
        context: &mut FeatureContext<'_>,
    ) {
        let documents = &*context.documents;
        let step = ExplainedStep {
            run: documents.run.generation,
            time,
            landmark,
        };
        let is_known = self.answered == Some(step);
        let is_asked = self.asked.is_some_and(|(_, asked)| asked == step);
        // One question at a time: while the flight plays, the latest one is asked next.
        let is_busy = self.asked.is_some() && context.playback.playing;
        if is_known || is_asked || is_busy {
            return;
        }
        if let Some(job) = explanation(by, step, documents) {
            self.stop(context);
            self.asked = Some((context.start(job), step));
        }
    }

    /// Takes note of an event; the step that it is about, if it is about the question under way.
    pub fn take(&mut self, job: JobId, event: &JobEvent) -> Option<ExplainedStep> {
        let (_, step) = self.asked.filter(|(asked, _)| *asked == job)?;
        let is_answer = matches!(
            event,
            JobEvent::Match(_) | JobEvent::Detector(_) | JobEvent::Failed(_) | JobEvent::Finished
        );
        if is_answer {
            self.answered = Some(step);
        }
        if event.is_last() {
            self.asked = None;
        }
        Some(step)
    }

    /// Stops the question under way.
    pub fn stop(&mut self, context: &mut FeatureContext<'_>) {
        if let Some((job, _)) = self.asked.take() {
            context.cancel(job);
        }
    }
}

/// Job that explains a landmark in a step of the run that is open; `None` if the step has no picture.
fn explanation(by: ExplainedBy, of: ExplainedStep, documents: &Documents) -> Option<Job> {
    let step = documents.run.navigated.as_ref()?.step_at(of.time)?;
    step.frame.as_ref()?;
    // Another map may be open since: with that one, nothing would explain what was measured.
    let over = documents.run.over.as_ref();
    Some(Job::ExplainMatch(ExplainOrder {
        by,
        flight: documents.flight.source.clone(),
        map: over.unwrap_or(&documents.map.source).clone(),
        mission: documents.mission.clone(),
        step: Box::new(step.clone()),
        landmark: of.landmark,
    }))
}
