//! What was measured of a landmark.

use pilotage_core::plan::DetectionStatistics;
use serde::{Deserialize, Serialize};

use crate::jobs::Assessment;

/// What was measured of a landmark.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// The last measurement.
    pub last: Assessment,
    /// By height.
    pub statistics: DetectionStatistics,
}
