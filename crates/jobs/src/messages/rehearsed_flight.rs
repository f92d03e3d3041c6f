//! A planned route that is flown in the simulation.

use pilotage_core::frames::Geodetic;
use serde::{Deserialize, Serialize};

use super::map_source::MapSource;
use super::predict::{PlannedPath, PredictionOrder};

/// Planned route flown in the simulation: over its map as it looks on another day, in a wind near the one that is
/// planned with; day, wind, gusts and sensors are drawn by a seed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RehearsedFlight {
    /// Name of the route.
    pub name: String,
    /// Origin of the world frame.
    pub origin: Geodetic,
    /// Path of the plan.
    pub path: PlannedPath,
    /// Standard deviation of the wind about the planned one, per axis, m/s.
    pub wind_deviation: f64,
    /// The map, as which the ground looks on the day of the map.
    pub map: MapSource,
    /// Seed of wind, day and sensors.
    pub seed: u64,
}

impl RehearsedFlight {
    /// The route `name` of a plan over a map in the world around `origin`, in a wind as well known as at the start of that
    /// plan.
    pub fn of_plan(
        plan: PredictionOrder,
        (name, origin): (String, Geodetic),
        map: MapSource,
        seed: u64,
    ) -> Self {
        Self {
            name,
            origin,
            wind_deviation: plan.navigator.start.wind,
            path: plan.path,
            map,
            seed,
        }
    }
}
