//! Heights of an area, and the description of an elevation model.

use pilotage_core::frames::{Geodetic, GroundRect};
use pilotage_core::imagery::terrain::HeightDatum;
use serde::{Deserialize, Serialize};

/// Heights wanted of an area: event `Heights`. Ground that cannot be read may be too high: where a part of the area cannot, the
/// order fails, and gives none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeightsOrder {
    /// Key of the files with the elevation model.
    pub key: String,
    /// Origin of the world frame.
    pub origin: Geodetic,
    /// The ground whose heights are wanted, in the world frame.
    pub area: GroundRect,
    /// Name of the elevation model among the files; the first that is one by its content if absent.
    pub file: Option<String>,
}

/// Description of an elevation model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TerrainInfo {
    /// Name for people.
    pub name: String,
    /// Datum of its heights.
    pub datum: HeightDatum,
    /// Metres between its posts.
    pub spacing: f64,
    /// A place in its middle.
    pub middle: Geodetic,
}
