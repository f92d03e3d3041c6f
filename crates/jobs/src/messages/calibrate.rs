//! A camera to be put in time and place beside its log.

use pilotage_core::calibration::{CameraEvidence, CameraPrior};
use serde::{Deserialize, Serialize};

/// A camera to be estimated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CalibrationOrder {
    /// The frames that were laid on the map, and the log around them.
    pub evidence: CameraEvidence,
    /// Prior of the camera's alignment: standard deviations about zero.
    pub believed: CameraPrior,
}
