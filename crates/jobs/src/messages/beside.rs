//! Simulation, bookmarks and measurements open beside a mission, as the mission file states them.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{KeptMeasurement, SimulationOptions};

/// Simulation, bookmarks and measurements open beside a mission, as its file states them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Beside {
    /// The built-in flight.
    pub simulation: Option<SimulationOptions>,
    /// Bookmarks, seconds in the flight's time base.
    pub bookmarks: Vec<f64>,
    /// Measurements of the mission's landmarks, for as long as they are true.
    pub measured: Vec<KeptMeasurement>,
}

impl Beside {
    /// From the members of a mission file's head, which are JSON text; `None` where nothing is stated or another program
    /// stated it.
    pub fn of_head(members: &BTreeMap<String, String>) -> Option<Self> {
        serde_json::from_str(members.get(BESIDE)?).ok()
    }
}

/// Name of the head's member with what is open beside a mission.
pub const BESIDE: &str = "open";
