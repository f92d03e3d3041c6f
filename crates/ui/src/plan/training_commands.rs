//! Detectors trained: its commands carried out, and what came of it kept with the landmarks.

use pilotage_jobs::TrainOrder;

use super::planner::Planner;
use super::tab::PlanTab;
use super::train_command::TrainCommand;
use crate::documents::landmarks::LandmarkChange;
use crate::feature::FeatureContext;

impl Planner {
    /// Carries a command out.
    pub(super) fn train(&mut self, command: TrainCommand, context: &FeatureContext<'_>) {
        let ids = match command {
            TrainCommand::Start(ids) => ids,
            TrainCommand::Selected => self.marked(*context.selection),
            TrainCommand::All => {
                let wanted = TrainOrder::wanted(&context.documents.mission);
                wanted.map(|landmark| landmark.id).collect()
            }
            TrainCommand::Photos(photos) => {
                self.preferences.photos = photos;
                return;
            }
            TrainCommand::Pause(which) => return self.trainings.pause(which, true),
            TrainCommand::Resume(which) => return self.trainings.pause(which, false),
            TrainCommand::Cancel(which) => return self.trainings.cancel(which),
        };
        self.tab = PlanTab::Landmarks;
        let orders = self.train_orders(&ids, context.documents);
        self.trainings.ask(orders);
    }

    /// Keeps detectors that are ready with the landmarks they were trained for.
    pub(super) fn keep_detectors(&mut self, context: &mut FeatureContext<'_>) {
        for (trained, outcome) in self.trainings.take_ready() {
            let landmark = context.documents.mission.landmark(trained.id);
            let Some(landmark) = landmark.filter(|l| l.bounds == trained.bounds) else {
                continue;
            };
            let title = format!("The detector of {} is trained", landmark.name);
            let text = format!(
                "Found in {} of {} photos that it did not learn from; trained in {:.0}\u{a0}s.",
                outcome.found, outcome.judged, outcome.seconds
            );
            let change = LandmarkChange::Trained(outcome.detector);
            context.document_changed();
            if context
                .documents
                .edit_landmarks(&[trained.id], &change, true)
            {
                context.run_is_stale();
            }
            context.note(&title, text);
        }
    }

    /// Takes the trainings of the last visit, and says so if one was left.
    pub(super) fn recall_trainings(&mut self, context: &mut FeatureContext<'_>) {
        self.trainings.recall(context.host);
        let left = self.trainings.left();
        let Some(first) = left.first() else {
            return;
        };
        let title = match left.len() {
            1 => format!("The training of {first} was left"),
            count => format!("{count} trainings of detectors were left"),
        };
        let text = "Resume it in Plan, under Landmarks: it goes on behind its last whole stage.";
        context.note(&title, text);
    }
}
