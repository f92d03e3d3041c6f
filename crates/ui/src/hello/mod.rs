//! A feature with a job: it has a worker say hello.

use egui::Ui;
use pilotage_jobs::{DescribeMapOrder, Job, JobEvent, JobId, MapSource};
use serde_json::Value;

use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo};
use crate::shell::catalog::{Entry, Group, entry};

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: "hello",
    tab: "Hello",
    commands,
};

/// The one command.
#[derive(Debug, PartialEq)]
struct SayHello;

fn say_hello() -> Command {
    Command::Feature(FeatureCommand::new(INFO.id, SayHello))
}

fn commands() -> Vec<Entry> {
    vec![entry(Group::View, "Say hello", vec![], say_hello())]
}

/// Words of the worker, once they came.
#[derive(Debug, Default)]
pub struct Hello(Option<String>);

impl Feature for Hello {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        if command.action::<SayHello>().is_none() {
            return false;
        }
        context.show();
        context.start(Job::DescribeMap(DescribeMapOrder(MapSource::Scenery)));
        true
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, _documents: &Documents) {
        ui.label(self.0.as_deref().unwrap_or("Nobody said hello yet."));
        if ui.button("Say hello").clicked() {
            context.commands.push(say_hello());
        }
    }

    fn on_event(&mut self, _job: JobId, event: &JobEvent, _context: &mut FeatureContext<'_>) {
        if let JobEvent::MapInfo(info) = event {
            self.0 = Some(format!("Hello from {}", info.name));
        }
    }

    fn on_flight_changed(&mut self, _context: &mut FeatureContext<'_>) {
        self.0 = None;
    }

    fn state(&self) -> Value {
        self.0.clone().into()
    }
}
