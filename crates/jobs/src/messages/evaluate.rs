//! A detector to be judged, and what came of it.

use pilotage_core::mission::FrameLabels;
use pilotage_core::training::evaluation::{
    AtThreshold, EvaluatedLook, Evaluation, EvaluationSettings, Plot,
};
use serde::{Deserialize, Serialize};

use super::{AssessmentOrder, FlightSource, FlownCamera};

/// Photos that are taken where nobody states a number, and the days on which.
const PHOTOS: (usize, usize) = (200, 20);
/// Most real frames that are looked at where nobody states a number.
const MOST_FRAMES: usize = 200;

/// Detector to be judged, and the real frames to judge it by.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvaluationOrder {
    /// The landmark with its detector, and the flights for which it is judged.
    pub about: AssessmentOrder,
    /// A recorded flight; its frames are looked at if the truth of it is known.
    pub flight: Option<FlightSource>,
    /// Camera by which its frames are looked at.
    pub camera: FlownCamera,
    /// Labels from which the detector may have learned: frames with labels of the landmark are not looked at, nor are those
    /// that show mostly the same ground.
    pub labels: Vec<FrameLabels>,
    /// Photos to take.
    pub photos: usize,
    /// Days on which they are taken.
    pub days: usize,
    /// Seed of photos and days.
    pub seed: u64,
    /// Most real frames that are looked at, evenly spread over the flight.
    pub most_frames: usize,
    /// False alarms per picture at which detections are told.
    pub false_alarms: f64,
}

impl EvaluationOrder {
    /// Order with the usual settings.
    pub fn usual(about: AssessmentOrder, flight: Option<FlightSource>) -> Self {
        let settings = EvaluationSettings::default();
        Self {
            about,
            flight,
            camera: FlownCamera::default(),
            labels: Vec::new(),
            photos: PHOTOS.0,
            days: PHOTOS.1,
            seed: settings.seed,
            most_frames: MOST_FRAMES,
            false_alarms: settings.false_alarms,
        }
    }
}

/// A detector that was judged, with everything that it was judged by.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JudgedDetector {
    /// Name of its landmark.
    pub landmark: String,
    /// The detector's own threshold.
    pub threshold: f64,
    /// Outcome at that threshold.
    pub in_use: AtThreshold,
    /// The same in the real frames alone, if those of a flight were asked for.
    pub in_real_frames: Option<AtThreshold>,
    /// Curves and figures of all looks.
    pub evaluation: Evaluation,
    /// Every look.
    pub looks: Vec<EvaluatedLook>,
}

/// Result of an evaluation, ready to be shown and saved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvaluationReport {
    /// The landmark.
    pub landmark: u32,
    /// Its name.
    pub name: String,
    /// The figures that matter most.
    pub figures: Vec<String>,
    /// Basis of the figures: numbers of pictures and days, and the meaning of bands and brackets.
    pub basis: String,
    /// The plots, each with itself as SVG.
    pub plots: Vec<(Plot, String)>,
    /// Every figure as one table.
    pub csv: String,
    /// Whether there is more to be looked at.
    pub is_partial: bool,
}
