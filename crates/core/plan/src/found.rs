//! Routes that were found, and what they are worth.

use serde::{Deserialize, Serialize};

use pilotage_base::frames::GroundPoint;

/// A route and what it is worth.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FoundRoute {
    /// Way-points, both ends included.
    pub way_points: Vec<GroundPoint>,
    /// Its length, metres.
    pub length: f64,
    /// Duration in the wind, without turns, seconds.
    pub time: f64,
    /// Greatest metres since the last fix: root mean square over the ways in which detections may turn
    /// out. Those before the first fix count as often as the question says.
    pub worst_blind: f64,
    /// Their mean over the way.
    pub mean_blind: f64,
}

/// The shortest allowed route, and the surest one within the budget.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FoundRoutes {
    /// The shortest allowed.
    pub shortest: FoundRoute,
    /// The surest; the shortest itself where nothing is better.
    pub surest: FoundRoute,
}
