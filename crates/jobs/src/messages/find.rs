//! A route to be found, and what was found.

use pilotage_core::frames::GroundPoint;
use pilotage_core::imagery::terrain::HeightGrid;
use pilotage_core::plan::{Aim, BudgetOf, FoundRoute, NoFlyArea, RoutePrediction, Turns};
use serde::{Deserialize, Serialize};

use super::{FieldOrder, PredictionOrder};

/// Route to be found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FindOrder {
    /// Start of the route.
    pub from: GroundPoint,
    /// End of the route.
    pub to: GroundPoint,
    /// The ground and how it is looked at.
    pub field: FieldOrder,
    /// Settings of flight and navigation; the way-points are found.
    pub flight: PredictionOrder,
    /// Areas to fly around.
    pub no_fly: Vec<NoFlyArea>,
    /// Distance that is kept from them, metres.
    pub clearance: f64,
    /// Ground that is flown around because it is too high.
    pub high_ground: Option<HighGround>,
    /// Turns of the aircraft between legs.
    pub turns: Turns,
    /// Greatest cost over that of the shortest route.
    pub budget: f64,
    /// Measure of the cost: time or length.
    pub budget_of: BudgetOf,
    /// Uncertainty that is to be least: the worst or the mean.
    pub aim: Aim,
}

impl FindOrder {
    /// Name of a route that was found.
    pub const FOUND: &str = "Found route";
    /// Greatest cost over that of the shortest route where nobody states one.
    pub const BUDGET: f64 = 1.3;
    /// Distance that is kept from no-fly areas where nobody states one, metres.
    pub const CLEARANCE: f64 = 50.0;
    /// Height that is kept above the ground of an elevation model where nobody states one, metres.
    pub const GROUND_CLEARANCE: f64 = 60.0;
}

/// Ground above a height.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HighGround {
    /// The height of the ground; where it is not known, it is none.
    pub heights: HeightGrid,
    /// Greatest height of ground that may be flown over, metres above the datum of the heights.
    pub highest: f64,
}

/// A route and what is predicted of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Foreseen {
    /// The route.
    pub route: FoundRoute,
    /// The prediction.
    pub prediction: RoutePrediction,
}

impl Foreseen {
    /// Largest predicted standard deviation of the position (longer axis), metres; zero without a sample.
    pub fn worst_sigma(&self) -> f64 {
        self.sigmas().fold(0.0, f64::max)
    }

    /// Its mean along the route, metres.
    pub fn mean_sigma(&self) -> f64 {
        self.sigmas().sum::<f64>() / self.prediction.samples.len().max(1) as f64
    }

    fn sigmas(&self) -> impl Iterator<Item = f64> {
        let samples = self.prediction.samples.iter();
        samples.map(|sample| sample.corridor.sigma_major)
    }
}

/// The shortest route and the one that was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FoundPlan {
    /// The shortest allowed.
    pub shortest: Foreseen,
    /// The surest.
    pub surest: Foreseen,
}
