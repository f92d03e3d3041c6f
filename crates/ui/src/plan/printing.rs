//! The brief whose pictures are being made.

use pilotage_core::frames::GroundRect;
use pilotage_core::landmark::Landmark;
use pilotage_jobs::JobId;

/// A landmark of the brief.
#[derive(Clone, Debug, PartialEq)]
pub struct BriefLandmark {
    /// The landmark.
    pub landmark: Landmark,
    /// Detection probability, in words.
    pub found: String,
}

/// Brief whose pictures are being made.
#[derive(Debug)]
pub struct Printing {
    /// Job that makes them.
    pub job: JobId,
    /// Ground of its map.
    pub area: GroundRect,
    /// Landmarks in it, in order.
    pub landmarks: Vec<BriefLandmark>,
    /// Number of landmarks that are too many for it.
    pub more: usize,
}
