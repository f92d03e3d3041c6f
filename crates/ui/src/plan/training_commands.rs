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
        let documents = &*context.documents;
        let ids = match command {
            TrainCommand::Start(ids) => ids,
            TrainCommand::Selected => self.marked(*context.selection),
            TrainCommand::All => {
                let wanted = TrainOrder::wanted(&documents.mission);
                wanted.map(|landmark| landmark.id).collect()
            }
            TrainCommand::Photos(photos) => {
                self.preferences.photos = photos;
                return;
            }
            TrainCommand::Pause(which) => return self.trainings.pause(which, true, documents),
            TrainCommand::Resume(which) => return self.trainings.pause(which, false, documents),
            TrainCommand::Cancel(which) => return self.trainings.cancel(which, documents),
        };
        self.tab = PlanTab::Landmarks;
        let orders = self.train_orders(&ids, documents);
        self.trainings.ask(orders);
    }

    /// Keeps detectors that are ready with the landmarks they were trained for.
    pub(super) fn keep_detectors(&mut self, context: &mut FeatureContext<'_>) {
        for (map, trained, outcome) in self.trainings.take_ready() {
            if map != context.documents.map.source {
                continue;
            }
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

    /// Says so once if a training of what is open was left at the last visit.
    pub(super) fn tell_left(&mut self, context: &mut FeatureContext<'_>) {
        let left = self.trainings.take_left(context.documents);
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
