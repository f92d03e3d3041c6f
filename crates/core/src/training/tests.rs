//! A whole training over ground that takes no time to draw.

use std::sync::Arc;

use super::*;
use crate::camera::CameraModel;
use crate::frames::{GroundPoint, GroundRect};
use crate::imagery::{Imagery, Window};
use crate::landmark::TemplateSettings;
use crate::landmark::trained::TrainedDetector;
use crate::landmark::{
    ChosenDetector, Detector, DetectorChoice, Landmark, SearchRequest, Sighting,
};
use crate::navigator::NavigatorSettings;
use crate::plan::OtherDays;
use crate::raster::{Raster, Rgba};

/// Fields with a house of two wings, and sheds of which each looks like a wing.
struct Farm {
    /// Grey levels by which it is brighter, and which way its rough grass grew.
    brighter: i32,
    grown: u32,
}

impl Farm {
    fn grey(&self, p: &GroundPoint) -> i32 {
        let inside = |north: f64, east: f64, height: f64, width: f64| {
            (p.north - north).abs() < 0.5 * height && (p.east - east).abs() < 0.5 * width
        };
        let shed = inside(-40.0, 30.0, 8.0, 16.0) || inside(35.0, -38.0, 8.0, 16.0);
        let house = inside(2.0, 0.0, 8.0, 24.0) || inside(-5.0, 8.0, 14.0, 8.0);
        let field = if (p.north / 31.0).floor() as i64 % 2 == 0 {
            96
        } else {
            118
        };
        let cell = ((p.north * 0.7).floor() as i64 as u32).wrapping_mul(0x9e37_79b9)
            ^ ((p.east * 0.7).floor() as i64 as u32).wrapping_mul(0x85eb_ca6b)
            ^ self.grown;
        let rough = (cell.wrapping_mul(0x27d4_eb2f) >> 27) as i32 - 16;
        self.brighter
            + if house || shed {
                190
            } else {
                field + rough / 2
            }
    }
}

impl Imagery for Farm {
    fn name(&self) -> &'static str {
        "farm"
    }
    fn bounds(&self) -> GroundRect {
        GroundRect::centered(GroundPoint::default(), 400.0, 400.0)
    }
    fn native_gsd(&self) -> f64 {
        0.5
    }
    fn window(&self, window: &Window) -> Raster<Rgba> {
        Raster::from_fn(window.width, window.height, |column, row| {
            let p = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
            let grey = self.grey(&p).clamp(0, 255) as u8;
            [grey, grey, grey, 255]
        })
    }
}

struct FarmDays;

impl OtherDays for FarmDays {
    fn drawn(&self, seed: u64) -> Arc<dyn Imagery> {
        Arc::new(Farm {
            brighter: (seed % 41) as i32 - 20,
            grown: seed as u32,
        })
    }
}

fn farm() -> Arc<dyn Imagery> {
    Arc::new(Farm {
        brighter: 0,
        grown: 0,
    })
}

fn house() -> Landmark {
    Landmark::new(
        7,
        "house",
        GroundRect::centered(GroundPoint::default(), 32.0, 32.0),
    )
}

fn envelope() -> FlightEnvelope {
    let camera = CameraModel::pinhole(320, 240, 60_f64.to_radians());
    FlightEnvelope::around(&camera, 120.0, NavigatorSettings::default().sensors)
}

fn training(seed: u64) -> DetectorTraining {
    let plan = TrainingPlan {
        photos: 24,
        shown: 3,
        negatives: 300,
        days: 8,
        last_votes: 30,
        held_out: 24,
        seed,
        ..TrainingPlan::default()
    };
    DetectorTraining::new(&house(), &farm(), &FarmDays, &envelope(), plan)
}

fn trained(mut training: DetectorTraining) -> (TrainedDetector, Vec<evaluation::EvaluatedLook>) {
    while training.advance().unwrap() {}
    (training.trained().unwrap(), training.looks().to_vec())
}

#[test]
fn a_house_is_learned_from_the_map_and_found_on_other_days_but_its_sheds_are_not() {
    let (detector, looks) = trained(training(3));
    let passes = |score: Option<f64>| score.is_some_and(|s| s >= detector.least_score);
    let found = looks.iter().filter(|l| passes(l.found_at())).count();
    let deceived = looks.iter().filter(|l| passes(l.deceived_at())).count();
    assert_eq!(looks.len(), 24);
    assert!(found >= 22, "found in {found}");
    assert!(deceived <= 1, "deceived in {deceived}");
    assert!(detector.covariance[(0, 0)].sqrt() < 1.0, "{detector:?}");
    let sure = detector.likelihood;
    assert!(sure.slope > 0.0 && sure.probability(-3.0) < 0.5, "{sure:?}");
}

#[test]
fn the_same_seed_trains_the_same_detector_though_it_was_left_halfway() {
    let (whole, _) = trained(training(5));
    let mut left = training(5);
    while left.reports().len() < 2 {
        assert!(left.advance().unwrap());
    }
    let progress = left.progress();
    assert_eq!(progress.stages.len(), 2);
    let (resumed, _) = trained(training(5).resumed(progress));
    assert_eq!(whole, resumed);
    let mut judged = training(5);
    while judged.phase() != TrainingPhase::Judging {
        assert!(judged.advance().unwrap());
    }
    assert_eq!(whole, trained(training(5).resumed(judged.progress())).0);
    assert_ne!(whole, trained(training(6)).0);
}

#[test]
fn the_detector_chosen_for_a_landmark_finds_it_and_one_for_another_box_is_not_used() {
    let (detector, _) = trained(training(3));
    let mut landmark = house();
    landmark.keep_trained(Some(&detector));
    landmark.choose_detector(DetectorChoice::Cascade);
    assert_eq!(landmark.trained_detector().as_ref(), Some(&detector));
    let (envelope, days) = (envelope(), [FarmDays.drawn(99)]);
    let mut camera = Photographer::new(&landmark, farm(), &days, envelope.clone(), 12);
    let mut errors = Vec::new();
    for choice in [DetectorChoice::Cascade, DetectorChoice::Both] {
        landmark.choose_detector(choice);
        let mut chosen = ChosenDetector::new(
            farm(),
            TemplateSettings::default(),
            std::slice::from_ref(&landmark),
        );
        for _ in 0..6 {
            let photo = camera.take().unwrap();
            let assumed = camera.assume(&photo).unwrap();
            let request = SearchRequest {
                landmark: &landmark,
                displacement_covariance: assumed.covariance,
            };
            let sighting = chosen.detect(&photo.view(&assumed, envelope.ground_down), &request);
            if let Sighting::Found(found) = sighting {
                errors.push(found.ground.distance(&assumed.appears));
            }
        }
    }
    assert!(errors.len() >= 9, "found {} of 12", errors.len());
    assert!(errors.iter().all(|e| *e < 2.0), "{errors:?}");
    landmark.reshape(landmark.bounds.grown(2.0));
    assert_eq!(landmark.trained_detector(), None);
}

#[test]
fn a_landmark_larger_than_the_picture_is_said_to_be_so() {
    let mut large = house();
    large.reshape(GroundRect::centered(GroundPoint::default(), 150.0, 150.0));
    let mut training = DetectorTraining::new(
        &large,
        &farm(),
        &FarmDays,
        &envelope(),
        TrainingPlan::default(),
    );
    let told = training.advance().unwrap_err().to_string();
    assert!(
        told.contains("\"house\" does not fit into a picture"),
        "{told}"
    );
}
