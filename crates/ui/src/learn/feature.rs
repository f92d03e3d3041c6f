//! The tour as a feature, with the line of advice that leads to it.

use egui::{Rect, Ui};
use pilotage_jobs::FlightSource;
use serde_json::Value;

use super::advice::advice;
use super::command::{ID, LearnCommand};
use super::lessons;
use super::tour::{LESSONS, Tour};
use crate::command::{Command, Workspace};
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::host::TOUR_KEY;
use crate::shell::NextStep;
use crate::shell::catalog::{BarMenu, CommandEntry, CommandGroup, entry};
use crate::shell::icons::Icon;
use crate::state_json::object;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "Learn",
    place: FeaturePlace::Workspace(Workspace::Learn),
    commands,
};

fn commands() -> Vec<CommandEntry> {
    let learn = entry(
        CommandGroup::View,
        "Show Learn: the guided tour",
        vec![],
        LearnCommand::Toggle.into(),
    );
    let learn = learn.also("help tutorial teach explain how");
    let lessons = entry(
        CommandGroup::View,
        "Open the lessons: courses on the method",
        vec![],
        LearnCommand::OpenLessons.into(),
    );
    let lessons = lessons.also(
        "help tutorial lesson teach course explain how learn presenter presentation slides handout",
    );
    vec![learn.under(BarMenu::Help), lessons.under(BarMenu::Help)]
}

/// The tour, and the line of advice that leads to it.
#[derive(Default)]
pub struct LearnFeature {
    tour: Tour,
    /// Whether the tour is on.
    is_on: bool,
    /// Whether people want no advice.
    is_advice_dismissed: bool,
}

impl LearnFeature {
    /// Takes note of what the view remembers.
    fn look(&mut self, context: &FeatureContext<'_>) {
        self.is_on = context.is_shown;
        self.is_advice_dismissed = context.view.advice_dismissed;
    }
}

impl Feature for LearnFeature {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        match command.action::<LearnCommand>() {
            Some(LearnCommand::Toggle) if context.is_shown => {
                context.view.workspace = Workspace::Replay;
            }
            Some(LearnCommand::Toggle) => context.show(),
            Some(LearnCommand::OpenLessons) => {
                context.egui.open_url(egui::OpenUrl::new_tab(LESSONS));
            }
            Some(LearnCommand::DismissAdvice) => context.view.advice_dismissed = true,
            None => return false,
        }
        true
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, _documents: &Documents) {
        self.tour.show(ui, context);
    }

    fn page(&self) -> Option<usize> {
        Some(self.tour.number())
    }

    fn turn_to(&mut self, page: usize) {
        self.tour.go_to(page);
    }

    fn keeps_picture(&self) -> bool {
        true
    }

    fn advice(
        &self,
        ui: &mut Ui,
        rect: Rect,
        context: &mut ViewContext<'_>,
        documents: &Documents,
    ) -> Option<Rect> {
        if self.is_advice_dismissed {
            return None;
        }
        advice(ui, rect, context, documents)
    }

    fn next_step(&self, workspace: Workspace, documents: &Documents) -> Option<NextStep> {
        let is_demo = matches!(documents.flight.source, FlightSource::Simulated(_));
        (is_demo && workspace == Workspace::Replay).then(|| NextStep {
            icon: Icon::Learn,
            label: "Take the tour",
            command: Command::Feature(FeatureCommand::show(ID)),
        })
    }

    /// Shows the stop that the page was opened with, `#tour=gate`.
    fn start(&mut self, context: &mut FeatureContext<'_>) {
        let stop = context.host.recall(TOUR_KEY);
        let stop = stop.and_then(|bytes| String::from_utf8(bytes).ok());
        if let Some(number) = stop.as_deref().and_then(lessons::linked) {
            self.tour.go_to(number);
            context.view.workspace = Workspace::Learn;
        }
        self.look(context);
    }

    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        self.look(context);
    }

    /// The stop's number, from 0, and its title, while the tour is on.
    fn state(&self, _documents: &Documents) -> Value {
        if !self.is_on {
            return Value::Null;
        }
        object!({"stop": self.tour.number(), "title": self.tour.title()})
    }
}
