//! The ground that a mission is about.

use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::mission::Mission;

/// Ground around the routes, landmarks and rally points of a mission; `None` without any.
pub fn planned_ground(mission: &Mission) -> Option<GroundRect> {
    let routes = mission.routes.iter().flat_map(|r| &r.way_points);
    let places = routes.map(|w| w.position);
    let landmarks = mission.landmarks.iter();
    let corners = landmarks.flat_map(|l| {
        let b = l.bounds;
        [
            GroundPoint::new(b.north, b.west),
            GroundPoint::new(b.south, b.east),
        ]
    });
    let rally = mission.rally.iter().map(|point| point.position);
    GroundRect::around(places.chain(corners).chain(rally))
}
