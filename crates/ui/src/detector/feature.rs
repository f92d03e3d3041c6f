//! Trained detectors as a feature: what one saw and did in a picture, and how well it does elsewhere.

use egui::Ui;
use pilotage_core::landmark::{CascadeEvidence, Landmark};
use pilotage_jobs::{DetectorSearch, ExplainedBy, JobEvent, JobId};
use serde_json::Value;

use super::catalog::commands;
use super::command::ID;
use super::judgement::Judgement;
use super::{DetectorCommand, DetectorView};
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::explanations::{Explanations, of_run};
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::shell::CommandLack;
use crate::state_json::object;
use crate::views::ExplainedStep;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "Detector",
    place: FeaturePlace::PictureTab,
    commands,
};

/// Trained detectors, looked at.
#[derive(Default)]
pub struct DetectorFeature {
    view: DetectorView,
    asked: Explanations,
    found: Option<(ExplainedStep, DetectorSearch)>,
    judgement: Judgement,
}

impl Feature for DetectorFeature {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let Some(command) = command.action::<DetectorCommand>() else {
            return false;
        };
        match command {
            DetectorCommand::Explain { time, landmark } => {
                let of = (*time, *landmark);
                self.asked.ask(ExplainedBy::Cascade, of, context);
            }
            DetectorCommand::Show => context.show(),
            DetectorCommand::Evaluate => {
                let wanted = self.view.wanted().map(|(_, landmark)| landmark);
                self.judgement.open(wanted, context);
            }
            DetectorCommand::StopEvaluating => self.judgement.stop(context),
            DetectorCommand::SaveEvaluation(file) => {
                context.host.save_file(&file.name, file.text.as_bytes());
                context.note("Evaluation saved", file.name.as_str());
            }
            DetectorCommand::CloseEvaluation => self.judgement.close(),
            DetectorCommand::Stages(_) | DetectorCommand::Play => {
                if !context.is_shown {
                    context.show();
                }
                self.view.act(command);
            }
        }
        true
    }

    fn missing(
        &self,
        command: &FeatureCommand,
        documents: &Documents,
        _selected: Option<u32>,
    ) -> Option<CommandLack> {
        let (is_there, what) = match command.action()? {
            DetectorCommand::Stages(_) | DetectorCommand::Play => {
                (self.view.passed().1 > 0, "No search is shown")
            }
            DetectorCommand::Evaluate => {
                let landmarks = &documents.mission.landmarks;
                let is_trained = landmarks.iter().any(Landmark::is_trained);
                (is_trained, "No detector is trained")
            }
            _ => return None,
        };
        let advice = "Train a detector for a landmark first.";
        CommandLack::unless(is_there, what, advice)
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) {
        let search = of_run(self.found.as_ref(), documents);
        self.view.show(ui, context, search);
    }

    fn on_event(&mut self, job: JobId, event: JobEvent, _context: &mut FeatureContext<'_>) -> bool {
        let Some(step) = self.asked.take(job, &event) else {
            return self.judgement.take(job, event);
        };
        let search = match event {
            JobEvent::Detector(search) => *search,
            JobEvent::Failed(why) => DetectorSearch {
                time: step.time,
                landmark: step.landmark,
                found: Err(why),
            },
            JobEvent::Progress(..) | JobEvent::Finished | JobEvent::Cancelled => return true,
            _ => return false,
        };
        self.found = Some((step, search));
        true
    }

    fn on_flight_changed(&mut self, context: &mut FeatureContext<'_>) {
        self.asked.stop(context);
        self.found = None;
        self.judgement.leave_flight(context);
    }

    fn state(&self, documents: &Documents) -> Value {
        let (passed, stages) = self.view.passed();
        let shown = of_run(self.found.as_ref(), documents).map(|(_, search)| {
            let found = search.found.as_ref();
            object!({
                "time": search.time,
                "landmark": search.landmark,
                "trouble": found.err(),
                "left": found.map_or(Vec::new(), |found| {
                    (0..=found.stages.len()).map(|stage| found.left_after(stage)).collect()
                }),
                "mean_votes": found.map_or(0.0, |found| found.mean_votes),
                "all_votes": found.map_or(0, CascadeEvidence::all_votes),
            })
        });
        object!({
            "evaluation": self.judgement.state(),
            "wanted": self.view.wanted(),
            "passed": passed,
            "stages": stages,
            "shown": shown,
        })
    }

    fn is_open_over(&self) -> bool {
        self.judgement.is_open
    }

    fn overlay(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, _documents: &Documents) {
        self.judgement.dialog(ui, context);
    }
}
