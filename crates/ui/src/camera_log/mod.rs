//! A camera put in time and place beside its log: estimated from the frames that were laid on the map, adjusted
//! by hand, applied to the flight.

mod chart;
mod numbers;
mod panel;
mod work;

pub use panel::{CameraLogScene, CameraLogView};
pub use work::{CameraLog, FoundCamera, Missing, Preview};

use pilotage_core::calibration::CameraAdjustment;

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
