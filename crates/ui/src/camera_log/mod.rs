//! A camera put in time and place beside its log: estimated from the frames that were laid on the map, adjusted
//! by hand, applied to the flight.

mod chart;
mod numbers;
mod panel;
mod work;

pub use panel::{CameraLogScene, CameraLogView};
pub use work::{CameraLog, FoundCamera, Missing, Preview};

use egui::Key;
use pilotage_core::calibration::CameraAdjustment;

use crate::command::Command;
use crate::feature_command::FeatureCommand;
use crate::shell::catalog::{Entry, Group, entry, shift};

/// Something to do about a camera beside its log.
#[derive(Clone, Debug, PartialEq)]
pub enum CameraLogCommand {
    /// Show it.
    Show,
    /// Show something else.
    Close,
    /// Estimate it from the run as it is.
    Estimate,
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
        Self::Feature(FeatureCommand::new("camera log", command))
    }
}

/// Rows of the table of all commands.
pub fn commands() -> Vec<Entry> {
    vec![entry(
        Group::View,
        "Camera to log: time offset, mount, focal length",
        vec![shift(Key::T)],
        CameraLogCommand::Show.into(),
    )]
}
