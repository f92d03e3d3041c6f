//! The content of a file that is written.

use crate::mission::{NoFlyZone, RallyPoint, Route};
use pilotage_vision::landmark::Landmark;

/// The content of one file.
#[derive(Clone, Copy, Debug, Default)]
pub struct Places<'a> {
    /// Routes.
    pub routes: &'a [Route],
    /// Landmarks.
    pub landmarks: &'a [Landmark],
    /// Areas that must not be flown over: plans have them as fences, KML and GeoJSON as marked polygons;
    /// other formats have none.
    pub no_fly: &'a [NoFlyZone],
    /// Places to land at when the aircraft cannot go on; without them those that a route's own file had are written.
    pub rally: Option<&'a [RallyPoint]>,
}
