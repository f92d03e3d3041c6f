//! Additions to the mission out of files.

use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{NoFlyZone, RallyPoint, Route};
use pilotage_core::roads::RoadLine;

use pilotage_jobs::ImportedFile;

/// Additions to the mission out of one file.
#[derive(Clone, Debug, Default)]
pub struct Brought {
    /// Routes; identities are unique in this file only.
    pub routes: Vec<Route>,
    /// Landmarks, likewise.
    pub landmarks: Vec<Landmark>,
    /// Areas that must not be flown over.
    pub no_fly: Vec<NoFlyZone>,
    /// Places to land at when the aircraft cannot go on.
    pub rally: Vec<RallyPoint>,
    /// Roads.
    pub roads: Vec<RoadLine>,
}

impl From<ImportedFile> for Brought {
    fn from(file: ImportedFile) -> Self {
        Self {
            routes: file.routes,
            landmarks: file.landmarks,
            no_fly: file.no_fly,
            rally: file.rally,
            roads: file.roads,
        }
    }
}
