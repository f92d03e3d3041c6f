//! Preferences of the search for a route, and the commands of the search.

use pilotage_core::frames::GroundPoint;
use pilotage_core::plan::{Aim, BudgetOf};
use pilotage_jobs::FindOrder;
use serde::{Deserialize, Serialize};

use super::heat_command::HeatOf;

/// Preferences of the search for a route; remembered between visits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct FindPreferences {
    /// Greatest cost over that of the shortest route.
    pub budget: f64,
    /// Measure of the cost: time or length.
    pub budget_of: BudgetOf,
    /// Uncertainty that is to be least: the worst or the mean.
    pub aim: Aim,
    /// Sources of fixes that the route shall lead over.
    pub over: HeatOf,
    /// Distance that is kept from no-fly areas, metres.
    pub clearance: f64,
    /// Height that is kept above the ground of the elevation model, metres.
    pub ground_clearance: f64,
}

impl Default for FindPreferences {
    fn default() -> Self {
        Self {
            budget: FindOrder::BUDGET,
            budget_of: BudgetOf::default(),
            aim: Aim::default(),
            over: HeatOf::default(),
            clearance: FindOrder::CLEARANCE,
            ground_clearance: FindOrder::GROUND_CLEARANCE,
        }
    }
}

/// Meaning of the next click on the map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FindPick {
    /// Nothing.
    #[default]
    Nothing,
    /// Start of the route.
    From,
    /// End of the route.
    To,
    /// The next corner of a no-fly area.
    Area,
}

/// Commands of the search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FindCommand {
    /// Choose both ends on the map, one after the other.
    Begin,
    /// Say what the next click means.
    Pick(FindPick),
    /// A click on the map.
    Click(GroundPoint),
    /// Finish the no-fly area that is being drawn.
    FinishArea,
    /// Look for other things.
    Set(FindPreferences),
    /// Search.
    Start,
    /// Stop searching.
    Stop,
    /// Make a route of what was found.
    Accept,
    /// Forget what was found.
    Dismiss,
    /// Delete a no-fly area, by its number.
    DeleteArea(usize),
}
