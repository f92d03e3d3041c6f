//! The common result of the readers of all formats.

use crate::mission::found::{FoundLandmark, FoundNoFly, FoundRally, ReadRoute};
use pilotage_base::frames::Geodetic;

pub(super) use crate::mission::found::POINT_BOX;

/// The content of a file, still on the globe.
#[derive(Default)]
pub(super) struct GeodeticContent {
    pub routes: Vec<ReadRoute>,
    pub landmarks: Vec<FoundLandmark>,
    pub no_fly: Vec<FoundNoFly>,
    pub rally: Vec<FoundRally>,
    pub notes: Vec<String>,
    /// Origin that the file states.
    pub origin: Option<Geodetic>,
}
