//! A detector to be trained, how that goes, and what came of it.

use pilotage_core::camera::CameraModel;
use pilotage_core::landmark::Landmark;
use pilotage_core::landmark::cascade::train::StageRow;
use pilotage_core::mission::{FrameLabels, Mission};
use pilotage_core::navigator::SensorNoise;
use pilotage_core::training::{StageReport, TrainingPhase, TrainingPlan};
use serde::{Deserialize, Serialize};

use super::{FlightSource, FlownCamera, MapSource, whole_bytes};

/// Detector to be trained, and the flights for which it is trained.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainOrder {
    /// The map.
    pub map: MapSource,
    /// The landmark.
    pub landmark: Landmark,
    /// The camera.
    pub camera: CameraModel,
    /// Height of the camera above ground, metres.
    pub height: f64,
    /// Errors of the camera's pose of which the filter does not know.
    pub sensors: SensorNoise,
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
    /// Training plan: the amount that the detector is shown.
    pub plan: TrainingPlan,
    /// Reach around the landmark within which what looks like it on the map is sought, metres: it is shown as well.
    /// Nothing is sought where it is zero.
    pub look_alikes_within: f64,
    /// Frames of a flight in which people showed the landmark, to learn from as well.
    pub labelled: Option<LabelledFrames>,
    /// State in which the same training was left.
    pub left: Option<TrainingLeft>,
}

impl TrainOrder {
    /// Landmarks that a training of all is about: those that are switched on and have no detector yet; all that are
    /// switched on where each has one.
    pub fn wanted(mission: &Mission) -> impl Iterator<Item = &Landmark> {
        let on = || mission.landmarks.iter().filter(|landmark| landmark.enabled);
        let is_any_without = on().any(|landmark| !landmark.is_trained());
        on().filter(move |landmark| !is_any_without || !landmark.is_trained())
    }

    /// Usual plan for a detector in a mission that learns from so many photos, held against the map's patch as the mission
    /// has that looked for.
    pub fn usual_plan(mission: &Mission, photos: usize) -> TrainingPlan {
        let usual = TrainingPlan::default();
        TrainingPlan {
            photos,
            days: usual.days.min(photos),
            held_out: usual.held_out.min(photos),
            template: mission.navigator.detector,
            ..usual
        }
    }
}

/// Frames of a flight, and what people said of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LabelledFrames {
    /// The flight.
    pub flight: FlightSource,
    /// Camera by which its frames are looked at.
    pub camera: FlownCamera,
    /// The labels.
    pub labels: Vec<FrameLabels>,
}

/// State from which a training can go on after its worker is gone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingLeft {
    /// Its stages that are whole, as the worker wrote them.
    #[serde(with = "whole_bytes")]
    pub progress: Vec<u8>,
    /// Reports on these stages.
    pub stages: Vec<StageReport>,
    /// Work in it, seconds.
    pub seconds: f64,
}

/// Progress of a training.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingReport {
    /// Share of the work that is done, about: 0 to 1.
    pub fraction: f32,
    /// Phase of the training.
    pub phase: TrainingPhase,
    /// Reports on the whole stages.
    pub stages: Vec<StageReport>,
    /// The stage that grows.
    pub growing: Option<StageRow>,
    /// Work so far, seconds.
    pub seconds: f64,
    /// State from which the training could go on, once another stage is whole.
    pub left: Option<TrainingLeft>,
}

/// Result of a training.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingOutcome {
    /// The detector, as [`Landmark::trained_text`] says it.
    pub detector: String,
    /// Reports on its stages.
    pub stages: Vec<StageReport>,
    /// Held-out photos of the landmark, and those in which it is found.
    pub judged: usize,
    /// Of these, those in which it is found.
    pub found: usize,
    /// Of all held-out photos, those in which something else is taken for it.
    pub false_alarms: usize,
    /// Score from which on a mark counts.
    pub least_score: f64,
    /// Standard deviation of the place, north and east, metres.
    pub sigmas: [f64; 2],
    /// Work in it, seconds.
    pub seconds: f64,
}
