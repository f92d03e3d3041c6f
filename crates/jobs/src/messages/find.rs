//! A route to be found, and what was found.

use pilotage_core::frames::{Altitude, GroundPoint};
use pilotage_core::imagery::terrain::HeightGrid;
use pilotage_core::mission::NoFlyZone;
use pilotage_core::plan::{
    Aim, BudgetOf, FoundRoute, ReachedZone, RoutePrediction, Turns, cruise, highest_ground,
    planned_aircraft, reached_zones,
};
use serde::{Deserialize, Serialize};

use super::{FieldOrder, FixesFrom, PredictionOrder};

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
    pub no_fly: Vec<NoFlyZone>,
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

/// Wishes for a route that is to be found.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RouteWishes {
    /// Greatest cost over that of the shortest route.
    pub budget: f64,
    /// Measure of the cost: time or length.
    pub budget_of: BudgetOf,
    /// Uncertainty that is to be least: the worst or the mean.
    pub aim: Aim,
    /// Sources of fixes that the route shall lead over.
    pub over: FixesFrom,
    /// Distance that is kept from no-fly areas, metres.
    pub clearance: f64,
    /// Height that is kept above the ground of the elevation model, metres.
    pub ground_clearance: f64,
}

impl Default for RouteWishes {
    fn default() -> Self {
        Self {
            budget: FindOrder::BUDGET,
            budget_of: BudgetOf::default(),
            aim: Aim::default(),
            over: FixesFrom::default(),
            clearance: FindOrder::CLEARANCE,
            ground_clearance: FindOrder::GROUND_CLEARANCE,
        }
    }
}

impl RouteWishes {
    /// Order to find such a route from one place to another, flown as `flight` says, whose turns are those of that flight
    /// with the wind behind it; `None` where the map reaches neither place.
    pub fn order(
        &self,
        (from, to): (GroundPoint, GroundPoint),
        field: FieldOrder,
        flight: PredictionOrder,
        no_fly: Vec<NoFlyZone>,
        high_ground: Option<HighGround>,
    ) -> Option<FindOrder> {
        let path = &flight.path;
        let bank = path.bank.unwrap_or_else(|| planned_aircraft().bank_limit);
        Some(FindOrder {
            from,
            to,
            field: field.between(&from, &to)?,
            no_fly,
            clearance: self.clearance,
            high_ground,
            turns: Turns::of_flight(cruise() + path.wind.speed, bank),
            budget: self.budget,
            budget_of: self.budget_of,
            aim: self.aim,
            flight,
        })
    }

    /// Greatest height of ground that a route at `altitude` is led over, metres above the datum of the elevation model, where
    /// the ground of its take-off is `take_off` high.
    pub fn highest_ground(&self, altitude: Altitude, take_off: f64) -> Option<f64> {
        highest_ground(altitude, take_off, self.ground_clearance)
    }
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

    /// Stretches on which its predicted corridor reaches into areas that it leads around.
    pub fn reached(&self, no_fly: &[NoFlyZone]) -> Vec<ReachedZone> {
        reached_zones(&self.prediction.samples, no_fly)
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
