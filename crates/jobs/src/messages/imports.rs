//! Routes, landmarks, areas and roads out of files of other programs.

use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{NoFlyZone, RallyPoint, Route};
use pilotage_core::roads::RoadLine;
use serde::{Deserialize, Serialize};

/// Content of a file of another program, placed in the mission's world.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ImportedFile {
    /// Name of the file.
    pub name: String,
    /// Name of its format.
    pub format: String,
    /// Its routes; identities are unique in this file only.
    pub routes: Vec<Route>,
    /// Its landmarks, likewise.
    pub landmarks: Vec<Landmark>,
    /// Areas that it says must not be flown over: its own, and exclusion fences.
    pub no_fly: Vec<NoFlyZone>,
    /// Places to land at when the aircraft cannot go on.
    pub rally: Vec<RallyPoint>,
    /// Roads.
    pub roads: Vec<RoadLine>,
    /// Assumptions, and things kept aside or left out, in sentences.
    pub notes: Vec<String>,
}
