//! Features: parts of the app with a panel, commands, jobs and a layer on the map of their own. The app holds a list
//! of them and knows none by name; a new one is a folder and a line in `features.rs`.

use egui::Ui;
use pilotage_core::flight::overview::Finding;
use pilotage_jobs::{Job, JobEvent, JobId};
use serde_json::Value;

use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::{Documents, ViewState};
pub use crate::feature_command::{FeatureAction, FeatureCommand, FeatureId};
use crate::host::Host;
use crate::map::{MapLayer, MapView};
use crate::shell::Toasts;
use crate::shell::catalog::Entry;
use crate::timeline::Playback;

/// Place of a feature's panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeaturePlace {
    /// A tab of the column at the right, below the camera picture.
    Tab,
    /// The whole column at the right, while it is shown.
    Sheet,
}

/// Description of a feature for whoever lists features.
#[derive(Debug)]
pub struct FeatureInfo {
    /// Identity.
    pub id: FeatureId,
    /// Name on its tab in the column at the right.
    pub tab: &'static str,
    /// Place of its panel.
    pub place: FeaturePlace,
    /// Its rows of the table of all commands.
    pub commands: fn() -> Vec<Entry>,
}

/// Wishes of a feature that the app fulfils once the feature is done.
#[derive(Debug, Default)]
pub struct FeatureWishes {
    /// Whether its panel is to be shown (true), or another one (false).
    pub show: Option<bool>,
    /// Whether the mission changed in a way that changes the run.
    pub is_run_stale: bool,
    /// Whether something changed that is stored with the documents.
    pub is_document_changed: bool,
    /// Commands that are carried out then.
    pub commands: Vec<Command>,
}

/// Part of the app that a feature may use while it does something.
pub struct FeatureContext<'a> {
    /// Documents that are open.
    pub documents: &'a mut Documents,
    /// Time cursor.
    pub playback: &'a mut Playback,
    /// Selected landmark.
    pub selection: &'a mut Option<u32>,
    /// Map view.
    pub map: &'a mut MapView,
    /// View state that is remembered between visits.
    pub view: &'a mut ViewState,
    /// Notices.
    pub toasts: &'a mut Toasts,
    /// Services of the shell.
    pub host: &'a mut dyn Host,
    /// Toolkit, for textures and repainting.
    pub egui: &'a egui::Context,
    /// Feature that does it.
    pub own: FeatureId,
    /// Owners of jobs.
    pub owners: &'a mut Vec<(JobId, FeatureId)>,
    /// Whether its panel is shown.
    pub is_shown: bool,
    /// Wishes that the app fulfils once the feature is done.
    pub wishes: FeatureWishes,
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

    /// Tells people something.
    pub fn note(&mut self, title: &str, text: impl Into<String>) {
        let now = self.host.now();
        self.toasts.note(now, title, text);
    }

    /// Tells people of something that failed.
    pub fn trouble(&mut self, title: &str, text: impl Into<String>) {
        let now = self.host.now();
        self.toasts.trouble(now, title, text);
    }

    /// Opens the feature's panel.
    pub fn show(&mut self) {
        self.wishes.show = Some(true);
    }

    /// Shows something else in the place of its panel.
    pub fn hide(&mut self) {
        self.wishes.show = Some(false);
    }

    /// Says that the mission changed in a way that changes the run.
    pub fn run_is_stale(&mut self) {
        self.wishes.is_run_stale = true;
    }

    /// Says that something changed that is stored with the documents.
    pub fn document_changed(&mut self) {
        self.wishes.is_document_changed = true;
    }

    /// Asks the app, or another feature, to do something once this is over.
    pub fn ask(&mut self, command: impl Into<Command>) {
        self.wishes.commands.push(command.into());
    }
}

/// Job that a feature has under way, as its panel tells of it.
#[derive(Debug, Default)]
pub struct FeatureWork {
    job: Option<JobId>,
    /// Progress in words, while the job is under way.
    pub words: Option<String>,
    /// Why the last one failed.
    pub trouble: Option<String>,
}

impl FeatureWork {
    /// Starts a job in the place of the one under way.
    pub fn begin(&mut self, words: String, job: Job, context: &mut FeatureContext<'_>) {
        self.stop(context);
        *self = Self {
            job: Some(context.start(job)),
            words: Some(words),
            trouble: None,
        };
    }

    /// Takes an event of the job: progress, failure and end; results are its owner's.
    pub fn take(&mut self, event: &JobEvent) {
        match event {
            JobEvent::Progress(share, words) => {
                self.words = Some(format!("{words}: {:.0} %", 100.0 * share));
            }
            JobEvent::Failed(why) => self.trouble = Some(why.clone()),
            _ => {}
        }
        if event.is_last() {
            (self.job, self.words) = (None, None);
        }
    }

    /// Stops the job under way; whether there was one.
    pub fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
        self.words = None;
        let job = self.job.take();
        if let Some(job) = job {
            context.cancel(job);
        }
        job.is_some()
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

    /// Does what is due, once a frame.
    fn tend(&mut self, _context: &mut FeatureContext<'_>) {}

    /// Takes note that the run that was under way is over, whole or not.
    fn on_run_over(&mut self, _is_whole: bool, _context: &mut FeatureContext<'_>) {}

    /// Findings about the flight, to be told with those of its log.
    fn findings(&self, _documents: &Documents) -> Vec<Finding> {
        Vec::new()
    }

    /// State of what is on screen, for journeys; null if there is nothing.
    fn state(&self, _documents: &Documents) -> Value {
        Value::Null
    }
}
