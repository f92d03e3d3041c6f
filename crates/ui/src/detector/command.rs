//! Commands about a trained detector.

use super::evaluation::EvaluationFile;
use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature.
pub(super) const ID: FeatureId = "detector";

/// Something about what a trained detector saw and did.
#[derive(Clone, Debug, PartialEq)]
pub enum DetectorCommand {
    /// Show the view.
    Show,
    /// Ask what the detector saw and did; may be sent every frame, asked once.
    Explain {
        /// Time of the step, seconds in the flight's time base.
        time: f64,
        /// Landmark id.
        landmark: u32,
    },
    /// Show what so many stages more have rejected; fewer if negative.
    Stages(i32),
    /// Let one stage after the other reject its windows, or stop.
    Play,
    /// Show how well the detector does where it was not trained.
    Evaluate,
    /// Stop judging it.
    StopEvaluating,
    /// Save a table or a plot of it.
    SaveEvaluation(EvaluationFile),
    /// Close what shows it.
    CloseEvaluation,
}

impl From<DetectorCommand> for Command {
    fn from(command: DetectorCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}
