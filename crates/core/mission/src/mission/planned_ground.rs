//! The ground that a mission is about.

use pilotage_base::frames::{GroundPoint, GroundRect};

use super::Mission;

impl Mission {
    /// Ground around its routes, landmarks and rally points; `None` without any.
    pub fn planned_ground(&self) -> Option<GroundRect> {
        let routes = self.routes.iter().flat_map(|r| &r.way_points);
        let places = routes.map(|w| w.position);
        let landmarks = self.landmarks.iter();
        let corners = landmarks.flat_map(|l| {
            let b = l.bounds;
            [
                GroundPoint::new(b.north, b.west),
                GroundPoint::new(b.south, b.east),
            ]
        });
        let rally = self.rally.iter().map(|point| point.position);
        GroundRect::around(places.chain(corners).chain(rally))
    }
}
