//! A whole training over ground that takes no time to draw.

use std::sync::Arc;

use nalgebra::Point3;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::*;
use pilotage_base::frames::{Attitude, GroundPoint, GroundRect, Pose};
use pilotage_flight::{Channel, ChannelName, Flight, Frame, StartFix};
use pilotage_mission::mission::{FrameLabels, LabelBox};
use pilotage_mission::settings::NavigatorSettings;
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{Picture, Raster, Rgba};
use pilotage_simulate::other_days::OtherDays;
use pilotage_simulate::simulate::{AerialCamera, AerialCameraSettings};
use pilotage_vision::landmark::trained::{DetectorWindow, TrainedDetector, Variants};
use pilotage_vision::landmark::{
    ChosenDetector, Detector, DetectorChoice, Landmark, SearchRequest, Sighting, TemplateSettings,
};

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

/// The farm around another place.
struct Moved(GroundPoint);

impl Imagery for Moved {
    fn name(&self) -> &'static str {
        "another farm"
    }
    fn bounds(&self) -> GroundRect {
        GroundRect::centered(self.0, 400.0, 400.0)
    }
    fn native_gsd(&self) -> f64 {
        0.5
    }
    fn window(&self, window: &Window) -> Raster<Rgba> {
        farm().window(&Window {
            north_edge: window.north_edge - self.0.north,
            west_edge: window.west_edge - self.0.east,
            ..*window
        })
    }
}

fn frame_named(name: &str) -> Frame {
    Frame {
        time: 1.0,
        name: name.to_owned(),
        stored_turn: 0.0,
    }
}

pub(super) struct FarmDays;

impl OtherDays for FarmDays {
    fn drawn(&self, seed: u64) -> Arc<dyn Imagery> {
        Arc::new(Farm {
            brighter: (seed % 41) as i32 - 20,
            grown: seed as u32,
        })
    }
}

pub(super) fn farm() -> Arc<dyn Imagery> {
    Arc::new(Farm {
        brighter: 0,
        grown: 0,
    })
}

pub(super) fn house() -> Landmark {
    Landmark::new(
        7,
        "house",
        GroundRect::centered(GroundPoint::default(), 32.0, 32.0),
    )
}

pub(super) fn envelope() -> FlightEnvelope {
    let camera = CameraModel::pinhole(320, 240, 60_f64.to_radians());
    FlightEnvelope::around(&camera, 120.0, NavigatorSettings::default().sensors)
}

fn training(seed: u64) -> DetectorTraining {
    DetectorTraining::new(&house(), &farm(), &FarmDays, &envelope(), plan(seed))
}

fn plan(seed: u64) -> TrainingPlan {
    TrainingPlan {
        photos: 24,
        shown: 3,
        negatives: 300,
        days: 8,
        last_votes: 30,
        held_out: 24,
        seed,
        ..TrainingPlan::default()
    }
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
    assert!(
        detector.precision.covariance[(0, 0)].sqrt() < 1.0,
        "{detector:?}"
    );
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
                turn_deviation: envelope.sensors.yaw,
                log_scale_deviation: envelope.sensors.height / photo.height,
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
fn where_heading_and_height_are_uncertain_turns_and_sizes_are_searched_and_measured() {
    let mut uncertain = envelope();
    uncertain.sensors.height = 10.0;
    uncertain.heading_error = 15_f64.to_radians();
    let variants = uncertain.variants();
    assert!(
        variants.turns.count == 3 && variants.log_scales.count == 4,
        "{variants:?}"
    );
    // So few as the others are judged by tell nothing of a reading for certain.
    let plan = TrainingPlan {
        held_out: 72,
        ..plan(3)
    };
    let training = DetectorTraining::new(&house(), &farm(), &FarmDays, &uncertain, plan);
    let (detector, looks) = trained(training);
    let passes = |score: Option<f64>| score.is_some_and(|s| s >= detector.least_score);
    let found = looks.iter().filter(|l| passes(l.found_at())).count();
    assert!(found >= 64, "found in {found}");
    // What is measured is known better than it was before: ±15° and a tenth at two standard deviations.
    let (turn, size) = (detector.precision.turn, detector.precision.log_scale);
    assert!(turn.is_some() || size.is_some(), "{:?}", detector.precision);
    assert!(
        turn.is_none_or(|t| t.variance.sqrt() < 8.0_f64.to_radians()),
        "{turn:?}"
    );
    assert!(size.is_none_or(|s| s.variance.sqrt() < 0.08), "{size:?}");
}

#[test]
fn an_error_that_no_variant_can_tell_is_left_open() {
    let (detector, _) = trained(training(3));
    assert_eq!(detector.window.variants.count(), 1);
    assert_eq!(
        (detector.precision.turn, detector.precision.log_scale),
        (None, None)
    );
    let template = detector.template.unwrap();
    assert!(
        template.log_ratio(0.9) > 0.0 && template.log_ratio(0.1) < 0.0,
        "{template:?}"
    );
}

#[test]
fn the_map_patch_is_judged_alike_wherever_the_reference_point_is() {
    let learned = |landmark: &Landmark| {
        let of = DetectorTraining::new(landmark, &farm(), &FarmDays, &envelope(), plan(3));
        trained(of).0.template.unwrap()
    };
    let mut aside = house();
    aside.reference.east += 6.0;
    let template = learned(&aside);
    assert_eq!(template, learned(&house()));
    assert!(template.log_ratio(0.9) > 0.0, "{template:?}");
}

/// A flight of three frames at the attitude of the test of labels.
fn three_frames(camera: &CameraModel) -> Flight {
    let channel = |name, value| Channel {
        name,
        times: vec![0.0, 2.0],
        values: vec![value; 2],
    };
    Flight {
        name: "flight".to_owned(),
        frame_on_globe: None,
        camera: camera.clone(),
        ground_down: 0.0,
        channels: vec![
            channel(ChannelName::Roll, 0.1),
            channel(ChannelName::Pitch, -0.06),
            channel(ChannelName::Heading, 2.0),
            channel(ChannelName::HeightAboveGround, 120.0),
        ],
        frames: ["a.jpg", "b.jpg", "c.jpg"].map(frame_named).to_vec(),
        start: StartFix {
            time: 0.0,
            position: GroundPoint::default(),
            standard_deviation: 5.0,
        },
        truth: None,
    }
}

#[test]
fn neighbours_among_labelled_frames_are_never_judged_by_each_other() {
    let names = (0..20).map(|number| format!("{number:02}.jpg"));
    let mut flight = three_frames(&envelope().camera);
    flight.frames = names.map(|name| frame_named(&name)).collect();
    let labels = flight.frames.iter().rev().map(|frame| FrameLabels {
        frame: frame.name.clone(),
        size: (320, 240),
        absent: vec![7],
        ..FrameLabels::default()
    });
    // As jobs read them: a frame at a time, in whatever order.
    let photos = labels.flat_map(|said| {
        let read = |_| Ok(Picture::from_fn(320, 240, |_, _| [90; 3]));
        labelled_photos(&flight, &[said], &house(), read).unwrap()
    });
    let days: Vec<_> = (labelled::in_stretches(photos.collect()).iter())
        .map(|photo| photo.day)
        .collect();
    assert_eq!(days[..5], [1000, 1000, 1000, 1000, 1001]);
    // A stage judges the groups of which number 4 is one of five.
    let judged: Vec<_> = (0..20).filter(|i| days[*i] % 5 == 4).collect();
    assert_eq!(judged, [16, 17, 18, 19]);
}

#[test]
fn a_label_shows_the_landmark_as_well_as_the_map_does_wherever_the_aircraft_was() {
    let (landmark, envelope) = (house(), envelope());
    let pose = Pose {
        position_in_world: Point3::new(1204.0, -453.0, -120.0),
        attitude: Attitude {
            roll: 0.1,
            pitch: -0.06,
            yaw: 2.0,
        },
    };
    // A farm elsewhere: nobody knows where the picture was taken.
    let place = GroundPoint::new(1200.0, -450.0);
    let there = Moved(place);
    let faults = AerialCameraSettings::default();
    let aerial = AerialCamera::new(envelope.camera.clone(), faults);
    let frame = aerial.take(&there, &pose, 0.0, &mut ChaCha8Rng::seed_from_u64(1));
    let in_world = Point3::new(place.north, place.east, 0.0);
    let pixel = envelope.camera.project(&pose, &in_world).unwrap();
    let corners = [-20.0, 20.0].map(|d| [pixel.x + d, pixel.y + d]);
    let label = LabelBox::new(7, "house", corners, (320, 240)).unwrap();
    let flight = three_frames(&envelope.camera);
    let said = |frame: &str, boxes, absent| FrameLabels {
        frame: frame.to_owned(),
        size: (320, 240),
        boxes,
        absent,
        ..FrameLabels::default()
    };
    let mut hard = label.clone();
    hard.difficult = true;
    let labels = [
        said("a.jpg", vec![label], Vec::new()),
        said("b.jpg", vec![hard], Vec::new()),
        said("c.jpg", Vec::new(), vec![7]),
    ];
    let read = |_| Ok(frame.picture.clone());
    let photos = labelled_photos(&flight, &labels, &landmark, read).unwrap();
    let mut others = labels.clone();
    for said in &mut others {
        said.flight = "flight from 0.0 m, 0.5 m".to_owned();
    }
    let of_another = labelled_photos(&flight, &others, &landmark, read).unwrap();
    assert!(of_another.is_empty(), "its pictures have the same names");
    // Of copies that were stretched to a square the boxes are where they are of the pictures.
    let stretched: Vec<_> = labels.iter().map(|said| said.at_size((320, 320))).collect();
    let of_copies = labelled_photos(&flight, &stretched, &landmark, read).unwrap();
    let [own, copy] = [&photos, &of_copies].map(|photos| photos[0].around.center());
    assert!(own.distance(&copy) < 0.01, "{own:?} {copy:?}");
    let present: Vec<(bool, usize)> = photos.iter().map(|p| (p.present, p.day)).collect();
    assert_eq!(present, [(true, 1000), (false, 1002)]);
    let shown = DetectorWindow::around(&landmark.bounds, 1.0, Variants::default());
    let assumed = Assumed {
        pose: photos[0].pose,
        heading_error: 0.0,
        log_scale: 0.0,
        appears: photos[0].around.center(),
        covariance: nalgebra::Matrix2::identity(),
    };
    let best = shown.variants.at(0);
    let sample = TrainingSample::of(
        &photos[0],
        &assumed,
        &envelope,
        &shown,
        &best,
        3.0,
        (0.0, 0.0),
    )
    .unwrap();
    let (left, top) = sample.landmark.unwrap();
    // The roof is at the corner of the box where the map has it, and field where it has field.
    let grey = |north: f64, east: f64| {
        let column = (16.0 + east / shown.gsd) as usize;
        let row = (16.0 - north / shown.gsd) as usize;
        i32::from(sample.picture.get(left + column, top + row))
    };
    for (north, east) in [
        (2.0, -9.0),
        (2.0, 9.0),
        (-9.0, 8.0),
        (9.0, 0.0),
        (-9.0, -6.0),
    ] {
        let on_map = Farm {
            brighter: 0,
            grown: 0,
        }
        .grey(&GroundPoint::new(north, east));
        let is_roof = on_map > 150;
        assert_eq!(
            grey(north, east) > 150,
            is_roof,
            "{north} {east}: {}",
            grey(north, east)
        );
    }
    let mut training = DetectorTraining::new(&landmark, &farm(), &FarmDays, &envelope, plan(3))
        .with_labelled(photos);
    while training.phase() == TrainingPhase::Photos {
        assert!(training.advance().unwrap());
    }
    assert_eq!(training.all_photos(), 26);
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
