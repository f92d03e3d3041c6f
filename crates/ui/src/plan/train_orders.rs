//! Orders of trainings for landmarks, and the labelled frames for them.

use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{FrameLabels, Mission};

use super::planner::Planner;
use crate::documents::Documents;
use pilotage_jobs::{FlightSource, FlownCamera, LabelledFrames, TrainOrder};

/// Labels of frames of a flight that tell of a landmark.
pub(super) fn labels_of<'a>(
    landmark: &'a Landmark,
    flight: &'a str,
    mission: &'a Mission,
) -> impl Iterator<Item = &'a FrameLabels> {
    let told = |l: &&FrameLabels| l.tells_of(landmark.id);
    let own = mission.labels.iter().filter(|l| l.is_of(flight));
    own.filter(told)
}

/// Frames of the flight that is open to learn a landmark from.
fn labelled(landmark: &Landmark, documents: &Documents) -> Option<LabelledFrames> {
    let flight = documents.flight.measured.as_ref()?.identity();
    let labels = labels_of(landmark, &flight, &documents.mission);
    let labels: Vec<_> = labels.cloned().collect();
    let is_open = documents.flight.source != FlightSource::Nothing;
    (is_open && !labels.is_empty()).then(|| LabelledFrames {
        flight: documents.flight.source.clone(),
        camera: FlownCamera::of(&documents.mission),
        labels,
    })
}

impl Planner {
    /// Orders of trainings for landmarks.
    pub fn train_orders(&self, ids: &[u32], documents: &Documents) -> Vec<TrainOrder> {
        let mission = &documents.mission;
        let with = self.planned_with(documents);
        let plan = TrainOrder::usual_plan(mission, self.preferences.photos);
        let landmarks = ids.iter().filter_map(|id| mission.landmark(*id));
        let order = |landmark: &Landmark| {
            with.training(landmark, plan.clone(), labelled(landmark, documents))
        };
        landmarks.map(order).collect()
    }
}
