//! Agreement of a view with a place, counted both ways.

use pilotage_base::frames::{GroundPoint, GroundRect};
use serde::{Deserialize, Serialize};

use super::field::bin;
use super::index::RoadIndex;
use super::prepared::{PreparedView, as_ground};
use super::view::{RoadView, ViewPose};

/// Upper ends of the classes of distance, metres; the last class has no end.
pub const DISTANCES: [f64; 7] = [2.0, 4.0, 6.0, 9.0, 13.0, 19.0, 27.0];
/// Number of classes of distance.
pub const CLASSES: usize = DISTANCES.len() + 1;
/// Distance from the edge of what was looked at within which roads need not have been seen, metres.
const EDGE: f64 = 8.0;

/// Points of a view and of the map by their distance from roads of the other that run alike.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct RoadEvidence {
    /// Points that were seen, by the distance of the nearest road of the map.
    pub seen: [u16; CLASSES],
    /// Points of the map's roads on the ground that was looked at, by the distance of the nearest that was seen.
    pub known: [u16; CLASSES],
}

/// Class of a distance; the last of what is no number.
fn class(distance: f64) -> usize {
    let last = DISTANCES.len();
    (DISTANCES.iter().position(|end| distance <= *end)).unwrap_or(last)
}

impl RoadEvidence {
    pub(super) fn of(
        pose: &ViewPose,
        view: &RoadView,
        prepared: &PreparedView,
        index: &RoadIndex,
    ) -> Self {
        let mut own = Self::default();
        for point in &prepared.points {
            let at = pose.on_map(point.place);
            let distance = index.field.distance(at, bin(point.direction + pose.turn));
            own.seen[class(distance)] += 1;
        }
        let corners = view.outline.iter().map(|corner| pose.on_map(*corner));
        let around: Option<GroundRect> = GroundRect::around(corners);
        if let Some(around) = around {
            index.tiles.visit_points(&around, |point| {
                let place = pose.in_view(point.place);
                if view.looked_at(place, EDGE) {
                    let at: GroundPoint = as_ground(place);
                    let distance = prepared
                        .field
                        .distance(at, bin(point.direction - pose.turn));
                    let count = &mut own.known[class(distance)];
                    *count = count.saturating_add(1);
                }
            });
        }
        own
    }

    /// Number of points that were seen.
    pub fn seen_points(&self) -> f64 {
        self.seen.iter().map(|count| f64::from(*count)).sum()
    }

    /// Number of points of the map on the ground that was looked at.
    pub fn known_points(&self) -> f64 {
        self.known.iter().map(|count| f64::from(*count)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_distance_is_not_near() {
        let classes = [0.0, 2.0, 2.1, 26.0, 30.0, f64::INFINITY, f64::NAN].map(class);
        assert_eq!(classes, [0, 0, 1, 6, 7, 7, 7]);
    }
}
