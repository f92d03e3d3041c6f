//! Areas that must not be flown over.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use pilotage_base::frames::GroundPoint;

/// An area that must not be flown over.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct NoFlyZone {
    /// Name for people.
    pub name: String,
    /// Its corners, at least three, in either order; the last is not the first again.
    pub corners: Vec<GroundPoint>,
    /// Rings inside of it that are not part of it, each of at least three corners. Routes are
    /// searched around the whole of the area, so that a hole is not flown into.
    #[serde(default)]
    pub holes: Vec<Vec<GroundPoint>>,
    /// Properties that a file brought and we do not know, by name, as JSON text.
    pub properties: BTreeMap<String, String>,
}
