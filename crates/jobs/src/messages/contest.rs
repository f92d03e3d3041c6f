//! A flight to be flown by every estimator.

use pilotage_core::mission::Mission;
use serde::{Deserialize, Serialize};

use super::{FlightSource, MapSource};

/// A flight to be flown by every estimator on the mission's own vehicle model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContestOrder {
    /// The flight.
    pub flight: FlightSource,
    /// The map.
    pub map: MapSource,
    /// Landmarks and settings.
    pub mission: Mission,
}
