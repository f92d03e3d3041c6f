//! Features: their commands and events brought to them, and what they ask of the app.

use super::{App, SideTab};
use crate::command::Workspace;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureId};
use crate::host::Host;
use pilotage_jobs::{JobEvent, JobId};

impl App {
    /// Lends the app to the feature at `index` while it does something.
    fn with_feature<R>(
        &mut self,
        index: usize,
        host: &mut dyn Host,
        work: impl FnOnce(&mut dyn Feature, &mut FeatureContext<'_>) -> R,
    ) -> R {
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
        let result = work(feature.as_mut(), &mut context);
        if context.is_to_be_shown {
            self.show_feature(own);
        }
        result
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
        let owner = self.feature(command.to());
        let is_done = owner.is_some_and(|index| {
            self.with_feature(index, host, |feature, context| {
                feature.execute(command, context)
            })
        });
        if !is_done {
            let text = format!("Nobody carries out {command:?}. This is a fault of the program.");
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
        let owner = self.owners.get(&id).copied();
        let Some(index) = owner.and_then(|owner| self.feature(owner)) else {
            return false;
        };
        if event.is_last() {
            self.owners.remove(&id);
        }
        self.with_feature(index, host, |feature, context| {
            feature.on_event(id, event, context);
        });
        true
    }

    /// Stops the work of the first feature that has any; whether one had.
    pub(super) fn stop_features(&mut self, host: &mut dyn Host) -> bool {
        (0..self.views.features.len())
            .any(|index| self.with_feature(index, host, |feature, context| feature.stop(context)))
    }

    /// Tells every feature that another flight is open.
    pub(super) fn tell_features_of_flight(&mut self, host: &mut dyn Host) {
        for index in 0..self.views.features.len() {
            self.with_feature(index, host, |feature, context| {
                feature.on_flight_changed(context);
            });
        }
    }
}
