//! Order of landmarks to be proposed.

use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::navigator::NavigatorSettings;
use pilotage_core::plan::FieldView;
use serde::{Deserialize, Serialize};

use super::MapSource;

/// Flight and map for which landmarks are proposed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SuggestOrder {
    /// The map.
    pub map: MapSource,
    /// Camera's view of the ground, and the uncertainty of the position then.
    pub view: FieldView,
    /// Way-points; without any the flight may go anywhere over the map.
    pub way_points: Vec<GroundPoint>,
    /// Speed, m/s.
    pub speed: f64,
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
    /// Settings of the navigator of the planned flight.
    pub navigator: NavigatorSettings,
    /// Boxes of landmarks that are there already.
    pub taken: Vec<GroundRect>,
    /// Greatest number of landmarks to propose.
    pub count: usize,
    /// Side of their boxes, metres; a third of the picture's shorter side on the ground if `None`.
    pub side: Option<f64>,
    /// Seed of the days on which places are rehearsed; [`Self::SEED`], so that the same plan has the same proposals.
    pub seed: u64,
}

impl SuggestOrder {
    /// Seed of proposals where nobody states one.
    pub const SEED: u64 = 1;
}
