//! Plan of a training: how much a detector is shown before it is trusted.

use serde::{Deserialize, Serialize};

use pilotage_base::frames::GroundPoint;
use pilotage_vision::landmark::TemplateSettings;
use pilotage_vision::landmark::cascade::train::{FeatureKind, StageGoal};
use pilotage_vision::landmark::trained::Preparation;

/// Plan of a detector's training.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingPlan {
    /// Kind of features that its cascade looks at.
    pub kind: FeatureKind,
    /// Photos that it learns from.
    pub photos: usize,
    /// Number of times that each of them is shown, under another error of pose and heading each time.
    pub shown: usize,
    /// Windows of something else that each stage learns from.
    pub negatives: usize,
    /// Days on which the photos are taken.
    pub days: usize,
    /// Goal of each stage, without the last.
    pub goal: StageGoal,
    /// Most stages, without the last.
    pub most_stages: usize,
    /// Votes of the last stage, which weighs what the others leave against everything they ever took for
    /// the landmark.
    pub last_votes: usize,
    /// Photos on other days that it is judged by; its threshold, likelihood and covariance come from
    /// them.
    pub held_out: usize,
    /// False alarms per photo that its threshold allows.
    pub false_alarms: f64,
    /// Places that look like the landmark.
    pub look_alikes: Vec<GroundPoint>,
    /// Settings of the search for map patches on the held-out photos, so that what they say can be weighed
    /// against what the cascade says.
    #[serde(default)]
    pub template: TemplateSettings,
    /// Preparation of the pictures before they are shown.
    #[serde(default)]
    pub preparation: Preparation,
    /// Draws everything.
    pub seed: u64,
}

impl Default for TrainingPlan {
    fn default() -> Self {
        Self {
            kind: FeatureKind::Hog,
            photos: 110,
            shown: 4,
            negatives: 1200,
            days: 37,
            goal: StageGoal::default(),
            most_stages: 12,
            last_votes: 120,
            held_out: 100,
            false_alarms: 0.01,
            look_alikes: Vec::new(),
            template: TemplateSettings::default(),
            preparation: Preparation::Rectified,
            seed: 1,
        }
    }
}
