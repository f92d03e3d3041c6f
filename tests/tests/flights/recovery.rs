//! A filter that was misled comes back, and one that was not stays.

use std::sync::Arc;

use nalgebra::{Matrix4, Vector2, Vector4};

use pilotage_core::frames::Pose;
use pilotage_core::landmark::{Detector, FrameView, SearchRequest, Sighting};
use pilotage_core::navigator::{Navigator, StepReport};
use pilotage_core::plan::{
    DetectionStatistics, ExpectedDetection, PlannedLandmark, StatedDetector, as_stated,
};
use pilotage_core::simulate::{Overrides, Scenario};

/// Choice of the detections that are wrong.
enum Wrong {
    Never,
    /// Those in the first frame with any.
    First(Option<Pose>),
    /// Those of one landmark.
    Landmark(u32),
}

/// A perfect detector, but for some detections that are as far off as `OFF`.
struct Misled {
    inner: StatedDetector,
    wrong: Wrong,
}

const OFF: Vector2<f64> = Vector2::new(22.0, -17.0);

impl Detector for Misled {
    fn detect(&mut self, view: &FrameView<'_>, request: &SearchRequest<'_>) -> Sighting {
        let mut sighting = self.inner.detect(view, request);
        if let Sighting::Found(found) = &mut sighting {
            let is_wrong = match &mut self.wrong {
                Wrong::Never => false,
                Wrong::First(pose) => *pose.get_or_insert(view.pose) == view.pose,
                Wrong::Landmark(id) => *id == request.landmark.id,
            };
            if is_wrong {
                found.ground = (found.ground.to_vector() + OFF).into();
            }
        }
        sighting
    }
}

/// Greatest error in the last half of a scenario's flight, metres, and its recoveries.
fn flown(seed: u64, wrong: Wrong, start: f64) -> (f64, Vec<f64>) {
    let scenario = &Scenario::all()[0];
    let flight = Arc::new(scenario.fly(seed, &Overrides::default()));
    let mission = scenario.mission();
    let mut settings = mission.navigator.clone();
    settings.start.position = start;
    let spread = Vector4::new(0.3, 0.3, 0.01, 0.01);
    let expected = ExpectedDetection {
        recognised: 1.0,
        per_frame: 1.0,
        covariance: Matrix4::from_diagonal(&spread.map(|sd: f64| sd * sd)),
    };
    let planned: Vec<PlannedLandmark> = mission
        .landmarks
        .iter()
        .map(|landmark| PlannedLandmark {
            landmark: landmark.clone(),
            detection: DetectionStatistics::everywhere(expected),
        })
        .collect();
    let (inner, mut frames) = as_stated(&flight, &planned, seed).expect("a truth");
    let detector = Box::new(Misled { inner, wrong });
    let navigator =
        Navigator::with_detector(Arc::clone(&flight), &mission.landmarks, detector, &settings)
            .expect("the flight has what it takes");
    let run = navigator.fly(&mut frames, &|| 0.0);
    let run = run.expect("the filter goes on");
    let truth = flight.truth.as_ref().expect("a truth");
    let error = |step: &StepReport| {
        let true_place = truth.position(step.time).expect("a place").xy();
        (step.after.position().to_vector() - true_place.coords).norm()
    };
    let last_half = &run.steps[run.steps.len() / 2..];
    let recoveries = run
        .steps
        .iter()
        .filter_map(|s| s.frame.as_ref()?.joint.as_ref()?.recovered);
    (
        last_half.iter().map(error).fold(0.0, f64::max),
        recoveries.collect(),
    )
}

#[test]
fn a_wrong_first_fix_is_got_over_when_other_landmarks_agree_against_it() {
    for seed in 1..=3 {
        let (error, recoveries) = flown(seed, Wrong::First(None), 20.0);
        assert!(!recoveries.is_empty(), "seed {seed}: {error} m");
        assert!(recoveries.iter().all(|f| *f > 1.0), "{recoveries:?}");
        assert!(error < 15.0, "seed {seed}: {error} m, {recoveries:?}");
    }
}

#[test]
fn a_right_belief_is_never_given_up() {
    for seed in 1..=5 {
        let (error, recoveries) = flown(seed, Wrong::Never, 3.0);
        assert!(recoveries.is_empty(), "seed {seed}: {recoveries:?}");
        assert!(error < 10.0, "seed {seed}: {error} m");
    }
}

#[test]
fn one_landmark_that_is_always_wrong_convinces_nobody() {
    for id in 1..=4 {
        let (error, recoveries) = flown(1, Wrong::Landmark(id), 3.0);
        assert!(recoveries.is_empty(), "landmark {id}: {recoveries:?}");
        assert!(error < 10.0, "landmark {id}: {error} m");
    }
}
