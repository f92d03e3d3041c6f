//! Detectors trained: its commands carried out, and what came of it kept with the landmarks.

use super::App;
use crate::documents::landmarks::LandmarkChange;
use crate::host::Host;
use crate::plan::{PlanTab, Planner, TrainCommand};

impl App {
    /// Carries a command out.
    pub(super) fn train(&mut self, command: TrainCommand) {
        let planner = &mut self.views.planner;
        let ids = match command {
            TrainCommand::Start(ids) => ids,
            TrainCommand::Selected => planner.marked(self.selection),
            TrainCommand::All => Planner::untrained(&self.documents),
            TrainCommand::Photos(photos) => {
                planner.preferences.photos = photos;
                return;
            }
            TrainCommand::Pause(which) => return planner.trainings.pause(which, true),
            TrainCommand::Resume(which) => return planner.trainings.pause(which, false),
            TrainCommand::Cancel(which) => return planner.trainings.cancel(which),
        };
        planner.tab = PlanTab::Landmarks;
        let orders = planner.train_orders(&ids, &self.documents);
        planner.trainings.ask(orders);
    }

    /// Keeps detectors that are ready with the landmarks they were trained for.
    pub(super) fn keep_detectors(&mut self, now: f64) {
        for (trained, outcome) in self.views.planner.trainings.take_ready() {
            let landmark = self.documents.mission.landmark(trained.id);
            let Some(landmark) = landmark.filter(|l| l.bounds == trained.bounds) else {
                continue;
            };
            let title = format!("The detector of {} is trained", landmark.name);
            let text = format!(
                "Found in {} of {} held-out photos after {:.0} s.",
                outcome.found, outcome.judged, outcome.seconds
            );
            let change = LandmarkChange::Trained(outcome.detector);
            let stale = self.documents.edit_landmarks(&[trained.id], &change, true);
            self.jobs.document_changed = true;
            if stale {
                self.run_is_stale(now);
            }
            self.toasts.note(now, title, text);
        }
    }

    /// Takes the trainings of the last visit, and says so if one was left.
    pub(super) fn recall_trainings(&mut self, host: &dyn Host) {
        let trainings = &mut self.views.planner.trainings;
        trainings.recall(host);
        let left = trainings.left();
        let Some(first) = left.first() else {
            return;
        };
        let title = match left.len() {
            1 => format!("The training of {first} was left"),
            count => format!("{count} trainings of detectors were left"),
        };
        let text = "Resume it in Plan, under Landmarks: it goes on behind its last whole stage.";
        self.toasts.note(host.now(), title, text);
    }
}
