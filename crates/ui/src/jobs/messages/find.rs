//! A route to be found, and what was found.

use pilotage_core::frames::GroundPoint;
use pilotage_core::imagery::terrain::HeightGrid;
use pilotage_core::plan::{Aim, BudgetOf, FoundRoute, NoFlyArea, Prediction, Turns};
use serde::{Deserialize, Serialize};

use super::{FieldOrder, PredictionOrder};

/// Which route to find.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FindOrder {
    /// Where it begins.
    pub from: GroundPoint,
    /// Where it ends.
    pub to: GroundPoint,
    /// The ground and how it is looked at.
    pub field: FieldOrder,
    /// How it is flown and navigated; the way-points are found.
    pub flight: PredictionOrder,
    /// Areas to fly around.
    pub no_fly: Vec<NoFlyArea>,
    /// Distance that is kept from them, metres.
    pub clearance: f64,
    /// Ground that is flown around because it is too high.
    pub high_ground: Option<HighGround>,
    /// How the aircraft turns.
    pub turns: Turns,
    /// Greatest cost over that of the shortest route.
    pub budget: f64,
    /// What the cost is.
    pub budget_of: BudgetOf,
    /// What is to be least.
    pub aim: Aim,
}

/// Ground above a height.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HighGround {
    /// The height of the ground; where it is not known, it is none.
    pub heights: HeightGrid,
    /// What is above that is too high, metres above the datum of the heights.
    pub highest: f64,
}

/// A route and what is predicted of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Foreseen {
    /// The route.
    pub route: FoundRoute,
    /// The prediction.
    pub prediction: Prediction,
}

/// The shortest route and the one that was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FoundPlan {
    /// The shortest allowed.
    pub shortest: Foreseen,
    /// The surest.
    pub surest: Foreseen,
}
