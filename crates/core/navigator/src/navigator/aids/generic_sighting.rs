//! Report of the landmarks in a picture, and of their pairs.

use super::super::sighting::{KnownReport, PairReport, SeenReport, SightedKind, SightingReport};
use super::aid::AidLook;
use pilotage_base::frames::GroundPoint;
use pilotage_mission::settings::GENERIC_LANDMARKS;
use pilotage_reference::GenericLandmark;
use pilotage_reference::association::{Association, ObservedLandmark};

/// Landmarks of the map that are told of lie within so many metres of what the picture shows.
const TOLD_AROUND: f64 = 40.0;

/// Report of what was seen, of the landmarks of the map within the `farthest` distance of the view and a little beyond,
/// metres, and of the pairs.
pub fn report(
    (observed, around): (&[ObservedLandmark], &[GenericLandmark]),
    association: &Association,
    look: &AidLook<'_>,
    farthest: f64,
) -> SightingReport {
    let below = look.below();
    let is_paired = |index: usize| association.pairs.iter().any(|p| p.possible == index);
    let told: Vec<usize> = (0..around.len())
        .filter(|index| {
            let distance = around[*index].place.distance(&below);
            distance <= farthest + TOLD_AROUND || is_paired(*index)
        })
        .collect();
    let pair_of = |index: usize| {
        let pair = association.pairs.iter().find(|p| p.observed == index)?;
        Some(PairReport {
            known: told.iter().position(|told| *told == pair.possible)?,
            probability: Some(pair.probability),
            accepted: pair.accepted,
        })
    };
    let seen = observed.iter().enumerate();
    let seen = seen.filter_map(|(index, landmark)| {
        let place = GroundPoint::from(below.to_vector() + landmark.place);
        Some(SeenReport {
            kind: SightedKind::Landmark(landmark.class),
            pixel: look.pixel_of(place)?,
            place,
            size: landmark.size,
            similar: association.similar[index],
            pair: pair_of(index),
        })
    });
    SightingReport {
        aid: GENERIC_LANDMARKS.aid.to_owned(),
        seen: seen.collect(),
        known: (told.iter())
            .map(|index| &around[*index])
            .map(|landmark| KnownReport {
                kind: SightedKind::Landmark(landmark.class),
                place: landmark.place,
                size: landmark.size,
            })
            .collect(),
        probability: (!association.pairs.is_empty()).then_some(association.probability),
    }
}
