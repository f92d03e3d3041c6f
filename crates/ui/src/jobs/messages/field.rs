//! Where a fix would be had: which field to compute.

use pilotage_core::frames::GroundRect;
use pilotage_core::plan::{FieldView, FixSource};
use serde::{Deserialize, Serialize};

use super::MapSource;

/// What gives fixes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum FieldFrom {
    /// Landmarks, and what is expected of them.
    Landmarks(Vec<FixSource>),
    /// Whatever the map itself offers: every place is rehearsed as if it were a landmark.
    Map {
        /// Half width of the detector's search in standard deviations.
        search_sigmas: f64,
    },
}

/// Which field to compute.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FieldOrder {
    /// The map.
    pub map: MapSource,
    /// The ground to be covered.
    pub region: GroundRect,
    /// How it is looked at.
    pub view: FieldView,
    /// What gives fixes.
    pub from: FieldFrom,
}
