//! Features: parts of the app with a panel, commands, jobs and a layer on the map of their own. The app holds a list
//! of them and knows none by name; a new one is a folder and a line in `features.rs`.

use egui::Ui;
use pilotage_jobs::{Job, JobEvent, JobId};
use serde_json::Value;

use crate::context::ViewContext;
use crate::documents::Documents;
pub use crate::feature_command::{FeatureAction, FeatureCommand, FeatureId};
use crate::host::Host;
use crate::map::MapLayer;
use crate::shell::Toasts;
use crate::shell::catalog::Entry;
use crate::timeline::Playback;

/// Description of a feature for whoever lists features.
#[derive(Debug)]
pub struct FeatureInfo {
    /// Identity.
    pub id: FeatureId,
    /// Name on its tab in the column at the right.
    pub tab: &'static str,
    /// Its rows of the table of all commands.
    pub commands: fn() -> Vec<Entry>,
}

/// Part of the app that a feature may use while it does something.
pub struct FeatureContext<'a> {
    /// Documents that are open.
    pub documents: &'a Documents,
    /// Time cursor.
    pub playback: &'a Playback,
    /// Notices.
    pub toasts: &'a mut Toasts,
    /// Services of the shell.
    pub host: &'a mut dyn Host,
    /// Feature that does it.
    pub own: FeatureId,
    /// Owners of jobs.
    pub owners: &'a mut Vec<(JobId, FeatureId)>,
    /// Whether the feature asks to be shown.
    pub is_to_be_shown: bool,
}

impl FeatureContext<'_> {
    /// Starts a job whose events come to the feature.
    pub fn start(&mut self, job: Job) -> JobId {
        let id = self.host.start(job);
        self.owners.push((id, self.own));
        id
    }

    /// Stops a job; nothing more of it comes to the feature.
    pub fn cancel(&mut self, job: JobId) {
        self.owners.retain(|(id, _)| *id != job);
        self.host.cancel(job);
    }

    /// Opens the feature's panel.
    pub fn show(&mut self) {
        self.is_to_be_shown = true;
    }
}

/// Part of the app with a panel, commands, jobs and a layer on the map of its own.
pub trait Feature {
    /// Description.
    fn info(&self) -> &'static FeatureInfo;

    /// Carries out a command that is addressed to it; false if it is none of its own.
    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool;

    /// Draws its panel.
    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents);

    /// Its layers on the map.
    fn layers(&self) -> Vec<&dyn MapLayer> {
        Vec::new()
    }

    /// Takes an event of a job that it started.
    fn on_event(&mut self, _job: JobId, _event: &JobEvent, _context: &mut FeatureContext<'_>) {}

    /// Stops its work because people asked for that; whether there was any.
    fn stop(&mut self, _context: &mut FeatureContext<'_>) -> bool {
        false
    }

    /// Forgets everything that belonged to the flight that was open: another one is.
    fn on_flight_changed(&mut self, _context: &mut FeatureContext<'_>) {}

    /// State of what is on screen, for journeys; null if there is nothing.
    fn state(&self) -> Value {
        Value::Null
    }
}
