//! The brief whose pictures are being made.

use pilotage_core::frames::GroundRect;
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::Route;
use pilotage_jobs::{JobId, MapSource, PredictionOrder};

/// A landmark of the brief.
#[derive(Clone, Debug, PartialEq)]
pub struct BriefLandmark {
    /// The landmark.
    pub landmark: Landmark,
    /// Detection probability, in words.
    pub found: String,
}

/// Pictures of a brief that are being made, and the plan that they are of.
#[derive(Debug)]
pub struct AskedPictures {
    /// Job that makes them.
    pub job: JobId,
    /// The map.
    pub map: MapSource,
    /// The route.
    pub route: Route,
    /// Order of its prediction, if it can be predicted.
    pub order: Option<PredictionOrder>,
    /// Ground of the map.
    pub area: GroundRect,
    /// Landmarks in it, in order.
    pub landmarks: Vec<BriefLandmark>,
    /// Number of landmarks that are too many for it.
    pub more: usize,
}

/// Brief that is to be printed.
#[derive(Debug)]
pub struct Printing {
    /// Id of its route.
    pub route: u32,
    /// Its pictures, once its route is predicted with all worlds.
    pub asked: Option<AskedPictures>,
}
