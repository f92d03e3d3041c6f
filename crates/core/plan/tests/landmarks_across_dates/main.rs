//! Landmarks that the planner proposes on a map of another date, looked for in photos; and what it says of boxes
//! beside what is found.
//!
//! Registration says where the photos were taken; a place counts as another's from 8 m on. `cargo test -p
//! pilotage-plan --test landmarks_across_dates -- --nocapture` prints every figure.
#![expect(
    clippy::unwrap_used,
    reason = "a test stops where something is missing"
)]

#[expect(dead_code, reason = "tests of the detector look beyond pictures, too")]
#[path = "../../../vision/tests/landmarks_across_dates/looks.rs"]
mod looks;
#[path = "../../../vision/tests/across_dates/photos.rs"]
mod photos;

use std::sync::Arc;

use looks::{ELSEWHERE, RegisteredPhotoTruth, Seen, TRACKING, Which, laid, look, tally};
use photos::Site;
use photos::studies::either;
use pilotage_base::frames::{GroundRect, Pose};
use pilotage_mission::settings::NavigatorSettings;
use pilotage_plan::{FieldView, LandmarkCandidate, Proposal, ProposalQuestion, Ranking, choose};
use pilotage_raster::imagery::{CachedImagery, Imagery};
use pilotage_simulate::other_days::PictureDays;
use pilotage_vision::landmark::{Landmark, TemplateDetector, TemplateFeatures, TemplateSettings};

/// Side of the boxes, metres.
const SIDE: f64 = 35.0;

fn detector() -> TemplateSettings {
    TemplateSettings {
        features: TemplateFeatures::Orientation,
        ..TemplateSettings::default()
    }
}

fn map_of(site: &Site) -> Arc<dyn Imagery> {
    Arc::new(CachedImagery::new(Arc::new(site.map.clone()), 64))
}

/// Candidates that the planner makes, after so many rehearsal days, of every place, half a side apart, that a
/// photo shows whole.
fn ranked(site: &Site, laid: &[RegisteredPhotoTruth<'_>], days: usize) -> Vec<LandmarkCandidate> {
    let map = map_of(site);
    let mut all = Proposal::days(&PictureDays::new(Arc::clone(&map)), 1);
    all.truncate(days);
    let days = all;
    let question = ProposalQuestion {
        map: Arc::clone(&map),
        days: days.clone(),
        view: FieldView {
            camera: laid[0].photo.camera.clone(),
            height: laid[0].photo.height,
            position: TRACKING.position,
            tilt: TRACKING.tilt,
        },
        way_points: Vec::new(),
        speed: 10.0,
        ground_down: 0.0,
        navigator: NavigatorSettings {
            detector: detector(),
            ..NavigatorSettings::default()
        },
        side: Some(SIDE),
        taken: Vec::new(),
    };
    let radius = question.view.searched(detector().search_sigmas, SIDE);
    let places = Ranking::new(Arc::clone(&map), &days, &map.bounds(), SIDE, radius)
        .by(detector().features)
        .seen_from(&question.view.camera, &frames(laid), 0.0);
    let mut places = places;
    while places.advance() {}
    places.ranked()
}

fn frames(laid: &[RegisteredPhotoTruth<'_>]) -> Vec<(f64, Pose)> {
    let times = (0..).map(|i| 10.0 * f64::from(i));
    times.zip(laid.iter().map(|l| l.pose)).collect()
}

fn landmarks(bounds: impl Iterator<Item = GroundRect>) -> Vec<Landmark> {
    let number = (0..).zip(bounds);
    number
        .map(|(id, bounds)| Landmark::new(id, "box", bounds))
        .collect()
}

fn looked(
    site: &Site,
    laid: &[RegisteredPhotoTruth<'_>],
    landmarks: &[Landmark],
    seed: u64,
) -> Vec<Seen> {
    let mut detector = TemplateDetector::new(map_of(site), detector());
    look(
        laid,
        landmarks,
        &mut detector,
        &TRACKING,
        seed,
        Which::Whole,
    )
}

/// By thirds of the boxes: mean predicted probability of their looks, share that was accepted with its standard
/// error (looks at a box go together), looks.
fn thirds(candidates: &[LandmarkCandidate], seen: &[Seen]) -> Vec<[f64; 4]> {
    let mut boxes: Vec<(f64, f64, f64)> = Vec::new();
    for (id, candidate) in candidates.iter().enumerate() {
        let own: Vec<&Seen> = seen.iter().filter(|s| s.landmark as usize == id).collect();
        let found = own.iter().filter(|s| s.accepted().is_some()).count();
        if !own.is_empty() {
            boxes.push((candidate.probability, own.len() as f64, found as f64));
        }
    }
    boxes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let third = |i: usize| &boxes[boxes.len() * i / 3..boxes.len() * (i + 1) / 3];
    let of = |part: &[(f64, f64, f64)]| {
        let looks: f64 = part.iter().map(|b| b.1).sum();
        let predicted = part.iter().map(|b| b.0 * b.1).sum::<f64>() / looks;
        let observed = part.iter().map(|b| b.2).sum::<f64>() / looks;
        let spread = part.iter().map(|b| (b.2 - observed * b.1).powi(2));
        [
            predicted,
            observed,
            spread.sum::<f64>().sqrt() / looks,
            looks,
        ]
    };
    (0..3).map(|i| of(third(i))).collect()
}

/// Prints what is said of all boxes in every `each`-th photo of a site beside what is found; returns the thirds.
fn reliability(name: &str, site: &Site, each: usize) -> Vec<[f64; 4]> {
    let laid: Vec<RegisteredPhotoTruth<'_>> = laid(site).into_iter().step_by(each).collect();
    // Look-alikes are the same on every day.
    let candidates = ranked(site, &laid, 2);
    let seen = looked(
        site,
        &laid,
        &landmarks(candidates.iter().map(|c| c.bounds)),
        1,
    );
    tally(name, &seen, ELSEWHERE);
    let thirds = thirds(&candidates, &seen);
    for [predicted, observed, error, looks] in &thirds {
        println!(
            "{name}: predicted {:.0} %, accepted {:.0} ± {:.0} % of {looks} looks",
            100.0 * predicted,
            100.0 * observed,
            100.0 * error
        );
    }
    thirds
}

#[test]
fn landmarks_that_the_planner_proposes_for_a_town_are_found_in_photos_of_another_date() {
    let Some(site) = photos::fengyuan() else {
        return;
    };
    let laid = laid(&site);
    let candidates = ranked(&site, &laid, usize::MAX);
    let chosen = choose(&candidates, &laid[0].photo.camera, &frames(&laid), 0.0, 10);
    for suggestion in &chosen {
        println!("{}", suggestion.reason);
    }
    let proposed = landmarks(chosen.iter().map(|s| s.candidate.bounds));
    let seen: Vec<Seen> = (1..=4)
        .flat_map(|seed| looked(&site, &laid, &proposed, seed))
        .collect();
    let tally = tally(
        "ten proposed landmarks, four draws of the errors",
        &seen,
        ELSEWHERE,
    );
    assert!(tally.share() >= 0.6, "{tally:?}");
    assert!(
        tally.wrong as f64 <= 0.005 * tally.looks as f64,
        "{tally:?}"
    );
}

#[test]
fn what_is_said_of_boxes_comes_true_on_maps_of_other_dates() {
    let (town, march) = (photos::fengyuan(), photos::adm("map_march"));
    let january = photos::adm("map_january");
    let Some(((town, january), march)) = town.zip(january).zip(march) else {
        return;
    };
    // These pairs are those to which the statement was fitted, by one place, turn and size of the errors.
    let sites = [
        ("town", &town, 1),
        ("fields, January", &january, 4),
        ("fields, March", &march, 4),
    ];
    // The everyday run asks of the town alone.
    for (name, site, each) in sites.into_iter().take(either(1, 3)) {
        for [predicted, observed, error, _] in reliability(name, site, each) {
            let off = (predicted - observed).abs();
            assert!(
                off < 0.1 + error,
                "{name}: {predicted:.3} {observed:.3} ± {error:.3}"
            );
        }
    }
}
