//! Landmarks looked for in photos of another date and sensor than the map's: boxes anywhere on it, good or not.
//!
//! Registration says where the photos were taken; that, the map and what stands up are good to some metres, so that a
//! place counts as wrong, another's, from 8 m on. `cargo test -p pilotage-vision --test landmarks_across_dates --
//! --nocapture` prints why looks are refused.
#![expect(
    clippy::unwrap_used,
    reason = "a test stops where something is missing"
)]

#[expect(dead_code, reason = "the planner's looks read more of it")]
mod looks;
#[path = "../across_dates/photos.rs"]
mod photos;

use std::sync::Arc;

use looks::{Doubt, ELSEWHERE, TRACKING, Tally, Which, boxes, laid, look, tally};
use photos::Site;
use photos::studies::either;
use pilotage_raster::imagery::Imagery;
use pilotage_vision::landmark::{TemplateDetector, TemplateFeatures, TemplateSettings};

/// Outcome of looks for boxes of 35 m, so many metres apart.
fn looked(
    site: &Site,
    step: f64,
    features: TemplateFeatures,
    doubt: &Doubt,
    which: Which,
) -> Tally {
    let map: Arc<dyn Imagery> = Arc::new(site.map.clone());
    let settings = TemplateSettings {
        features,
        ..TemplateSettings::default()
    };
    let mut detector = TemplateDetector::new(Arc::clone(&map), settings);
    let landmarks = boxes(map.as_ref(), 35.0, step);
    let seen = look(&laid(site), &landmarks, &mut detector, doubt, 1, which);
    tally(site.map.name(), &seen, ELSEWHERE)
}

#[test]
fn most_boxes_of_a_town_are_found_and_none_at_anothers_place() {
    let Some(site) = photos::fengyuan() else {
        return;
    };
    let by = |features| looked(&site, 20.0, features, &TRACKING, Which::Whole);
    let edges = by(TemplateFeatures::Orientation);
    assert!(edges.share() > 0.5 && edges.wrong == 0, "{edges:?}");
    assert!((0.7..1.5).contains(&edges.nees), "{edges:?}");
    if either(false, true) {
        let brightness = by(TemplateFeatures::Brightness);
        assert!(edges.share() > 1.4 * brightness.share(), "{brightness:?}");
    }
}

#[test]
fn boxes_of_fields_and_woods_are_hardly_ever_found_at_anothers_place() {
    let Some((january, march)) = photos::adm("map_january").zip(photos::adm("map_march")) else {
        return;
    };
    // The everyday run asks of one of the maps.
    for site in [&january, &march].into_iter().take(either(1, 2)) {
        let by = TemplateFeatures::Orientation;
        let seen = looked(site, 35.0, by, &TRACKING, Which::Whole);
        assert!(seen.share() > 0.1, "{seen:?}");
        assert!(seen.wrong <= 1, "{seen:?}");
    }
}

#[test]
fn boxes_beyond_the_edge_of_a_photo_are_not_found_in_it() {
    let Some(site) = photos::fengyuan() else {
        return;
    };
    let doubt = Doubt {
        position: 20.0,
        ..TRACKING
    };
    let by = TemplateFeatures::Orientation;
    let seen = looked(&site, 40.0, by, &doubt, Which::JustOutside);
    assert!(seen.looks > 150, "{seen:?}");
    // A box of which the camera's true pose shows less than half may be told by the rest.
    assert!(seen.accepted <= 1, "{seen:?}");
}
