//! Places to which the aircraft may go when it cannot go on.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::USUAL_ALTITUDE;
use pilotage_base::frames::{Altitude, GroundPoint};

/// A place to which the aircraft may go and land when it cannot go on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RallyPoint {
    /// Name for people.
    pub name: String,
    /// Place in the world.
    pub position: GroundPoint,
    /// Altitude at which the aircraft comes there.
    pub altitude: Altitude,
    /// Properties that a file brought and we do not know, by name, as JSON text.
    pub properties: BTreeMap<String, String>,
}

impl RallyPoint {
    /// The name of the rally point `number`, counted from one, where nobody gave it another.
    pub fn usual_name(number: usize) -> String {
        format!("Rally {number}")
    }

    /// A rally point of that number, counted from one, at the usual altitude.
    pub fn new(number: usize, position: GroundPoint) -> Self {
        Self {
            name: Self::usual_name(number),
            position,
            altitude: USUAL_ALTITUDE,
            properties: BTreeMap::new(),
        }
    }
}
