//! What is open beside a mission, as the mission file states it.

use serde::{Deserialize, Serialize};

use super::{KeptMeasurement, SimulationOptions};

/// What is open beside a mission, as its file states it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Beside {
    /// The built-in flight.
    pub simulation: Option<SimulationOptions>,
    /// Bookmarks, seconds in the flight's time base.
    pub bookmarks: Vec<f64>,
    /// What was measured of the mission's landmarks, for as long as it is true.
    pub measured: Vec<KeptMeasurement>,
}

/// Name of the head's member with what is open beside a mission.
pub const BESIDE: &str = "open";
