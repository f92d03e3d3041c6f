//! Which heights are wanted, and what is known of an elevation model.

use pilotage_core::frames::{Geodetic, GroundRect};
use pilotage_core::imagery::terrain::HeightDatum;
use serde::{Deserialize, Serialize};

/// Which heights are wanted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeightsOrder {
    /// Key of the files with the elevation model.
    pub key: String,
    /// Origin of the world frame.
    pub origin: Geodetic,
    /// The ground whose heights are wanted, in the world frame.
    pub area: GroundRect,
}

/// What is known of an elevation model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TerrainInfo {
    /// Name for people.
    pub name: String,
    /// What its heights count from.
    pub datum: HeightDatum,
    /// Metres between its posts.
    pub spacing: f64,
    /// A place in its middle.
    pub middle: Geodetic,
}
