//! The height of the ground under what is open.

use std::sync::Arc;

use pilotage_core::frames::{Geodetic, GroundPoint, GroundRect};
use pilotage_core::imagery::terrain::{HeightGrid, Terrain};

/// Key under which the storage has the key of the elevation model's files.
pub const TERRAIN_KEY: &str = "terrain";

/// The opened elevation model and the part of its heights that is at hand. Without a model nothing
/// is known: the ground counts as level.
///
/// Heights are metres above the model's datum, which is mean sea level for nearly all of them:
/// [`OpenedTerrain::datum`] names it.
#[derive(Clone, Debug, Default)]
pub struct OpenedTerrain {
    key: Option<String>,
    heights: Option<Arc<HeightGrid>>,
    /// Origin and area of the heights that are at hand or asked for.
    asked: Option<(Geodetic, GroundRect)>,
}

impl OpenedTerrain {
    /// An elevation model among files; its heights come later.
    pub fn of_files(key: &str) -> Self {
        Self {
            key: Some(key.to_owned()),
            ..Self::default()
        }
    }

    /// Key of the files with the elevation model.
    pub fn key(&self) -> Option<&str> {
        self.key.as_deref()
    }

    /// The heights at hand, to be shared with whoever computes with them.
    pub fn heights(&self) -> Option<&Arc<HeightGrid>> {
        self.heights.as_ref()
    }

    /// Name of the datum, if there are heights.
    pub fn datum(&self) -> Option<&str> {
        Some(self.heights.as_ref()?.datum().name())
    }

    /// Height of the ground at a place of the world frame, metres above the datum; `None` where it
    /// is not known.
    pub fn height_at(&self, place: &GroundPoint) -> Option<f64> {
        self.heights.as_ref()?.height_at(place)
    }

    /// Whether heights of `area` in the world around `origin` have to be asked for; if so, they
    /// count as asked for from now on.
    pub fn wants(&mut self, origin: Geodetic, area: &GroundRect) -> bool {
        let corners = [(area.south, area.west), (area.north, area.east)];
        let inside = |rect: &GroundRect| {
            let mut corners = corners.iter();
            corners.all(|(north, east)| rect.contains(&GroundPoint::new(*north, *east)))
        };
        let has = (self.asked.as_ref()).is_some_and(|(of, rect)| *of == origin && inside(rect));
        if self.key.is_none() || has {
            return false;
        }
        self.asked = Some((origin, *area));
        true
    }

    /// Takes heights that were asked for.
    pub fn take(&mut self, heights: HeightGrid) {
        let is_asked = (self.asked.as_ref()).is_some_and(|(_, area)| area == heights.area());
        if is_asked {
            self.heights = Some(Arc::new(heights));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(side: f64) -> GroundRect {
        GroundRect::centered(GroundPoint::new(0.0, 0.0), side, side)
    }

    #[test]
    fn heights_are_asked_for_once_until_more_ground_or_another_world_is_of_interest() {
        let origin = Geodetic::from_degrees(46.0, -92.0, 0.0);
        let mut nothing = OpenedTerrain::default();
        assert!(!nothing.wants(origin, &area(100.0)));
        let mut ground = OpenedTerrain::of_files("opened-1");
        assert!(ground.wants(origin, &area(1000.0)));
        assert!(!ground.wants(origin, &area(500.0)));
        assert!(ground.wants(origin, &area(2000.0)));
        let other = Geodetic::from_degrees(47.0, -92.0, 0.0);
        assert!(ground.wants(other, &area(500.0)));
    }
}
