//! Simulating as a feature.

use egui::{Key, Ui};
use pilotage_jobs::FlightSource;
use serde_json::Value;

use super::SimulateFeature;
use super::command::{ID, SimulateCommand};
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::shell::catalog::{BarMenu, CommandEntry, CommandGroup, entry, plain};
use crate::state_json::object;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "Simulate a flight",
    place: FeaturePlace::Dialog,
    commands,
};

fn commands() -> Vec<CommandEntry> {
    let show = Command::Feature(FeatureCommand::show(ID));
    let keys = vec![plain(Key::M)];
    let entry = entry(CommandGroup::Document, "Simulate a flight…", keys, show);
    let also = "scenario demo seed wind new";
    vec![entry.also(also).under(BarMenu::Open)]
}

impl Feature for SimulateFeature {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let Some(SimulateCommand(options)) = command.action() else {
            return false;
        };
        let flight = FlightSource::Simulated(options.clone());
        context.fly_own(flight, options.map());
        true
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, _documents: &Documents) {
        if self.dialog.is_open {
            self.dialog.show(ui, context);
        }
    }

    /// Opens the dialog, or closes it if it is open.
    fn on_shown(&mut self, _context: &mut FeatureContext<'_>) {
        self.dialog.is_open = !self.dialog.is_open;
    }

    fn is_open_over(&self) -> bool {
        self.dialog.is_open
    }

    fn state(&self, _documents: &Documents) -> Value {
        object!({ "open": self.dialog.is_open })
    }
}
