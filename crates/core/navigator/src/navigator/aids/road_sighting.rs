//! Report of the points of roads in a picture, and of the centre lines on which they lie.

use nalgebra::{Rotation2, Vector3};

use super::super::sighting::{KnownReport, PairReport, SeenReport, SightedKind, SightingReport};
use super::aid::AidLook;
use pilotage_base::frames::GroundPoint;
use pilotage_mission::settings::ROAD_MAP;
use pilotage_roads::{RoadFix, RoadFixSettings, RoadMap, RoadSighting};

/// Farthest from a centre line that a point counts as lying on it once the pose is corrected, metres.
const ON_ROAD: f64 = 6.0;

/// Report of the points, each paired with the place of a centre line on which the corrected pose puts it, if it
/// puts it on one.
pub fn report(
    look: &AidLook<'_>,
    points: &[(RoadSighting, f64)],
    fix: Option<&RoadFix>,
    map: &RoadMap,
    settings: &RoadFixSettings,
) -> SightingReport {
    let correction = fix.map_or(Vector3::zeros(), |fix| fix.correction);
    let turn = Rotation2::new(correction.z);
    let centre = look.below().to_vector();
    let mut known = Vec::new();
    let mut seen = Vec::new();
    for (sighting, width) in points {
        let from_centre = sighting.place.to_vector() - centre;
        let place = GroundPoint::from(centre + correction.xy() + turn * from_centre);
        let direction = sighting.direction + correction.z;
        let near = |reach| map.nearest_like(place, reach, direction, settings.turn);
        let Some(pixel) = look.pixel_of(sighting.place) else {
            continue;
        };
        let pair = near(ON_ROAD).map(|near| {
            known.push(KnownReport {
                kind: SightedKind::Road,
                place: near.foot,
                size: map.lines()[map.edge(near.edge).line].width,
            });
            PairReport {
                known: known.len() - 1,
                probability: None,
                accepted: fix.is_some(),
            }
        });
        seen.push(SeenReport {
            kind: SightedKind::Road,
            pixel,
            place: sighting.place,
            size: *width,
            similar: usize::from(near(settings.reach).is_some()),
            pair,
        });
    }
    SightingReport {
        aid: ROAD_MAP.aid.to_owned(),
        seen,
        known,
        probability: None,
    }
}
