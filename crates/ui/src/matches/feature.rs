//! Matches as a feature: the pictures that explain one, asked for, taken, shown.

use egui::Ui;
use pilotage_jobs::{ExplainedBy, JobEvent, JobId, MatchPictures};
use serde_json::Value;

use crate::command::Command;
use crate::context::{DrawnTimes, ViewContext};
use crate::documents::Documents;
use crate::explanations::{Explanations, of_run};
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::shell::catalog::{CommandEntry, CommandGroup, entry};
use crate::state_json::object;
use crate::views::{ExplainedStep, MATCH, MatchCommand, MatchView};

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: MATCH,
    tab: "Match",
    place: FeaturePlace::PictureTab,
    commands,
};

fn commands() -> Vec<CommandEntry> {
    vec![
        entry(
            CommandGroup::View,
            "Show how a landmark was matched",
            vec![],
            Command::Feature(FeatureCommand::show(MATCH)),
        )
        .also("why refused score template correlation"),
    ]
}

/// Matches of landmarks, explained.
#[derive(Default)]
pub struct MatchFeature {
    view: MatchView,
    asked: Explanations,
    found: Option<(ExplainedStep, Result<MatchPictures, String>)>,
}

impl Feature for MatchFeature {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let Some(MatchCommand { time, landmark }) = command.action() else {
            return false;
        };
        let of = (*time, *landmark);
        self.asked.ask(ExplainedBy::Template, of, context);
        true
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) {
        let pictures = of_run(self.found.as_ref(), documents);
        self.view.show(ui, context, pictures);
    }

    fn on_event(&mut self, job: JobId, event: JobEvent, _context: &mut FeatureContext<'_>) -> bool {
        let Some(step) = self.asked.take(job, &event) else {
            return false;
        };
        match event {
            JobEvent::Match(pictures) => self.found = Some((step, Ok(*pictures))),
            JobEvent::Failed(why) => self.found = Some((step, Err(why))),
            JobEvent::Progress(..) | JobEvent::Finished | JobEvent::Cancelled => {}
            _ => return false,
        }
        true
    }

    fn on_flight_changed(&mut self, context: &mut FeatureContext<'_>) {
        self.asked.stop(context);
        self.found = None;
    }

    fn state(&self, documents: &Documents) -> Value {
        let pictures = of_run(self.found.as_ref(), documents);
        pictures.map_or(
            Value::Null,
            |(of, _)| object!({"time": of.time, "landmark": of.landmark}),
        )
    }

    fn drawn(&self) -> Option<DrawnTimes> {
        self.view.drawn()
    }
}
