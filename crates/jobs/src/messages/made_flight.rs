//! A flight made of tables.

use pilotage_core::flight::Flight;
use serde::{Deserialize, Serialize};

/// A flight made of tables.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MadeFlight {
    /// The flight.
    pub flight: Flight,
    /// Omissions and assumptions, in words.
    pub notes: Vec<String>,
}
