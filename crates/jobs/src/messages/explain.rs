//! Explanations of places and matches: by the map, the picture and the detector.

use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::landmark::CascadeEvidence;
use pilotage_core::raster::Gray;
use serde::{Deserialize, Serialize};

/// Distinctness of a box of the map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Distinctness {
    /// The box.
    pub bounds: GroundRect,
    /// Correlation of the box with the map around it.
    pub surface: Gray,
    /// Ground that the surface covers.
    pub surface_rect: GroundRect,
    /// Distance around the box within which look-alikes were looked for, metres.
    pub radius: f64,
    /// Centre of the strongest look-alike, and its score.
    pub look_alike: Option<(GroundPoint, f64)>,
    /// Standard deviation of the patch's grey values, 0 to 255.
    pub contrast: f64,
    /// Whether the detector would refuse the patch as flat.
    pub flat: bool,
    /// Verdict for people, a sentence.
    pub verdict: String,
}

/// Pictures that explain a match.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MatchPictures {
    /// Time of the step.
    pub time: f64,
    /// The landmark.
    pub landmark: u32,
    /// The map patch.
    pub patch: Gray,
    /// The camera picture rectified to a north-up ground view over the search region.
    pub rectified: Gray,
    /// Score at every offset of the patch in the rectified picture.
    pub surface: Gray,
    /// Best offset (column, row) in `surface`, sub-pixel.
    pub peak: Option<(f64, f64)>,
    /// Second-best offset.
    pub second: Option<(f64, f64)>,
    /// Metres per pixel of all three.
    pub gsd: f64,
}

/// By what a landmark is looked for when a match is explained.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ExplainedBy {
    /// By its map patch.
    Template,
    /// By the detector that was trained for it.
    Cascade,
}

/// Search of a trained detector in a past step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DetectorSearch {
    /// Time of the step, seconds in the flight's time base.
    pub time: f64,
    /// The landmark.
    pub landmark: u32,
    /// Evidence of the search, or why that cannot be told.
    pub found: Result<CascadeEvidence, String>,
}
