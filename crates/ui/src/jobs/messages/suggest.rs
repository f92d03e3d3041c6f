//! What landmarks are to be proposed for.

use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::navigator::NavigatorSettings;
use pilotage_core::plan::FieldView;
use serde::{Deserialize, Serialize};

use super::MapSource;

/// What landmarks are proposed for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SuggestOrder {
    /// The map.
    pub map: MapSource,
    /// How the ground is looked at, and how uncertain the position is then.
    pub view: FieldView,
    /// Way-points; without any the flight may go anywhere over the map.
    pub way_points: Vec<GroundPoint>,
    /// Speed, m/s.
    pub speed: f64,
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
    /// How it will be navigated.
    pub navigator: NavigatorSettings,
    /// Boxes of landmarks that are there already.
    pub taken: Vec<GroundRect>,
    /// How many to propose at most.
    pub count: usize,
}
