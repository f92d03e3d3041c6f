//! The map over which a flight is flown that came without one.

use pilotage_core::frames::{Geodetic, LocalFrame};
use pilotage_jobs::MapSource;

use super::Documents;

/// Farthest from a flight that the origin of the map may lie that was open before, metres: what lies
/// further is a map of somewhere else.
const NEAR: f64 = 60_000.0;

impl Documents {
    /// The map that is open, if it lies where a flight is whose world frame is `frame`; else none.
    pub fn map_under(&self, frame: Option<LocalFrame>) -> MapSource {
        let open = &self.map.source;
        let map = self.map.info.as_ref();
        let at = open.origin().or_else(|| map.and_then(|map| map.origin));
        let is_near = |at: Geodetic| {
            let away = frame?.world_from_geodetic(&at);
            Some(away.x.hypot(away.y) < NEAR)
        };
        match at.and_then(is_near) {
            Some(true) => open.clone(),
            _ => MapSource::Nothing,
        }
    }
}

/// A map among a flight's own files, put into the world of the flight.
pub fn with_origin(map: MapSource, frame: Option<LocalFrame>) -> MapSource {
    match (map, frame) {
        (MapSource::Files(key), Some(frame)) => MapSource::Placed {
            key,
            origin: frame.origin,
        },
        (map, Some(frame)) => map.moved(frame.origin),
        (map, None) => map,
    }
}
