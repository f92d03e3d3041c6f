//! A camera put in time and place beside its log: estimated from the frames that were laid on the map, adjusted
//! by hand, applied to the flight.

mod chart;
mod feature;
mod numbers;
mod panel;
mod work;

pub use feature::CameraLogFeature;

use pilotage_core::calibration::CameraAdjustment;

use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature.
pub const ID: FeatureId = "camera_log";

/// Something to do about a camera beside its log.
#[derive(Clone, Debug, PartialEq)]
pub enum CameraLogCommand {
    /// Show something else.
    Close,
    /// Estimate it from the run as it is.
    Estimate,
    /// Stop estimating it.
    Stop,
    /// Lay whole pictures on the map in another run, then estimate.
    FlyAndEstimate,
    /// Believe the camera's clock before to be right within so many seconds (standard deviation).
    Believe(f64),
    /// Try it so by hand.
    Adjust(Box<CameraAdjustment>),
    /// Put the hand where the estimate is.
    UseEstimate,
    /// The flight as it was opened.
    Reset,
    /// Change the flight as the hand has it, and fly it again.
    Apply,
}

impl From<CameraLogCommand> for Command {
    fn from(command: CameraLogCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}
