//! Order of a field of the probability of a fix.

use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::plan::{FieldView, FixSource};
use serde::{Deserialize, Serialize};

use super::MapSource;

/// Choice of where fixes are to come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum FixesFrom {
    /// The landmarks that are switched on.
    #[default]
    Landmarks,
    /// Whatever the map offers.
    Map,
}

/// Sources of fixes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum FieldFrom {
    /// Landmarks, and what is expected of them.
    Landmarks(Vec<FixSource>),
    /// Whatever the map itself offers: every place is rehearsed as if it were a landmark.
    Map {
        /// Half width of the detector's search in standard deviations.
        search_sigmas: f64,
        /// Other days on which they are rehearsed; [`FieldFrom::FEW_DAYS`] to be soon done.
        days: usize,
    },
}

impl FieldFrom {
    /// Days of a field that somebody waits for.
    pub const FEW_DAYS: usize = 2;
}

/// Field of the probability of a fix to be computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FieldOrder {
    /// The map.
    pub map: MapSource,
    /// The ground to be covered.
    pub region: GroundRect,
    /// Camera's view of the ground, and its uncertainty.
    pub view: FieldView,
    /// Sources of fixes.
    pub from: FieldFrom,
}

impl FieldOrder {
    /// The same of no more of the map than a route between two places leads over that is within a usual budget; `None`
    /// where that is not on the map.
    #[must_use]
    pub fn between(mut self, from: &GroundPoint, to: &GroundPoint) -> Option<Self> {
        if let FieldFrom::Map { .. } = self.from {
            let far = 0.5 * from.distance(to) + self.view.height;
            let near = GroundRect::around([*from, *to])?.grown(far);
            self.region = near.intersection(&self.region)?;
        }
        Some(self)
    }
}
