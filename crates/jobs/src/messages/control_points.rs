//! Control points of a picture.

use pilotage_core::frames::ReferenceSystem;
use pilotage_core::imagery::georeferencer::ControlPoint;
use serde::{Deserialize, Serialize};

/// Control points out of a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReadControlPoints {
    /// Path of the file.
    pub file: String,
    /// The points, at least one, with their places in `plane`, metres.
    pub points: Vec<ControlPoint>,
    /// The plane that they are in.
    pub plane: ReferenceSystem,
    /// Assumptions about it, in sentences.
    pub notes: Vec<String>,
}
