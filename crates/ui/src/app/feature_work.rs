//! Features: their commands and events brought to them, and what they ask of the app.

use super::{App, SideTab};
use crate::command::Workspace;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureId};
use crate::host::Host;
use pilotage_jobs::{JobEvent, JobId};

impl App {
    /// Lends the app to the feature at `index` while it does something.
    fn with_feature(
        &mut self,
        index: usize,
        host: &mut dyn Host,
        work: &mut dyn FnMut(&mut dyn Feature, &mut FeatureContext<'_>),
    ) {
        let feature = &mut self.views.features[index];
        let own = feature.info().id;
        let mut context = FeatureContext {
            documents: &self.documents,
            playback: &self.playback,
            toasts: &mut self.toasts,
            host,
            own,
            owners: &mut self.owners,
            is_to_be_shown: false,
        };
        work(feature.as_mut(), &mut context);
        if context.is_to_be_shown {
            self.show_feature(own);
        }
    }

    fn show_feature(&mut self, id: FeatureId) {
        self.view.workspace = Workspace::Replay;
        self.view.side_open = true;
        self.dialogs.settings = false;
        self.side_tab = SideTab::Feature(id);
    }

    fn feature(&self, id: FeatureId) -> Option<usize> {
        self.views.features.iter().position(|it| it.info().id == id)
    }

    /// Has a feature carry out its command. One that nobody carries out is a fault of the program, and told.
    pub(super) fn execute_feature(&mut self, command: &FeatureCommand, host: &mut dyn Host) {
        let mut is_done = false;
        if let Some(index) = self.feature(command.to()) {
            self.with_feature(index, host, &mut |feature, context| {
                is_done = feature.execute(command, context);
            });
        }
        if !is_done {
            let of = command.to();
            let text =
                format!("Nobody carries out this command of {of}. This is a fault of the program.");
            self.toasts.trouble(host.now(), "Nothing was done", text);
        }
    }

    /// Brings an event to the feature that started its job; whether one did.
    pub(super) fn feature_event(
        &mut self,
        host: &mut dyn Host,
        id: JobId,
        event: &JobEvent,
    ) -> bool {
        let owner = self.owners.iter().find(|(job, _)| *job == id);
        let Some(index) = owner.and_then(|(_, owner)| self.feature(owner)) else {
            return false;
        };
        if event.is_last() {
            self.owners.retain(|(job, _)| *job != id);
        }
        self.with_feature(index, host, &mut |feature, context| {
            feature.on_event(id, event, context);
        });
        true
    }

    /// Stops the work of the first feature that has any; whether one had.
    pub(super) fn stop_features(&mut self, host: &mut dyn Host) -> bool {
        let mut had_work = false;
        for index in 0..self.views.features.len() {
            if !had_work {
                self.with_feature(index, host, &mut |feature, context| {
                    had_work = feature.stop(context);
                });
            }
        }
        had_work
    }

    /// Tells every feature that another flight is open.
    pub(super) fn tell_features_of_flight(&mut self, host: &mut dyn Host) {
        for index in 0..self.views.features.len() {
            self.with_feature(index, host, &mut |feature, context| {
                feature.on_flight_changed(context);
            });
        }
    }
}
