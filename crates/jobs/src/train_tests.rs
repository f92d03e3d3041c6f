//! Trainings from beginning to end on the calling thread, with few photos.

use std::cell::Cell;
use std::sync::OnceLock;

use pilotage_core::frames::GroundRect;
use pilotage_core::imagery::{GeoreferencedPicture, GroundFromPixel};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{LabelBox, Mission};
use pilotage_core::raster::Raster;
use pilotage_core::simulate::Scenario;
use pilotage_core::training::{TrainingPhase, TrainingPlan};

use super::*;
use crate::{
    Abilities, FlightSource, FlownCamera, Job, JobId, JobRunner, LabelledFrames, MapSource, Reply,
    Request, SimulationOptions,
};

fn order() -> TrainOrder {
    let scenario = Scenario::named("distinct-400ft-calm").unwrap();
    let mission = scenario.mission();
    TrainOrder {
        map: MapSource::world("countryside"),
        landmark: mission.landmarks[0].clone(),
        camera: Scenario::camera(),
        height: scenario.height,
        sensors: mission.navigator.sensors,
        ground_down: 0.0,
        plan: TrainingPlan {
            photos: 12,
            days: 6,
            negatives: 300,
            held_out: 6,
            last_votes: 15,
            ..TrainingPlan::default()
        },
        look_alikes_within: 0.0,
        labelled: None,
        left: None,
    }
}

/// A worker and what it said.
struct Bench {
    runner: JobRunner,
    said: Vec<(JobId, JobEvent)>,
    time: Cell<f64>,
}

impl Bench {
    fn new() -> Self {
        Self {
            runner: JobRunner::new(Abilities::WHOLE),
            said: Vec::new(),
            time: Cell::new(0.0),
        }
    }

    fn ask(&mut self, request: Request) {
        let said = &mut self.said;
        self.runner.receive(request, &mut |reply| {
            if let Reply::Event(id, event) = reply {
                said.push((id, event));
            }
        });
    }

    fn start(&mut self, id: JobId, order: TrainOrder) {
        self.ask(Request::Start(id, Job::Train(Box::new(order))));
    }

    /// A slice on a clock of which every look takes so many milliseconds.
    fn turn(&mut self, tick: f64) -> bool {
        let clock = || {
            self.time.set(self.time.get() + tick);
            self.time.get()
        };
        let said = &mut self.said;
        self.runner.turn(&clock, &mut |reply| {
            if let Reply::Event(id, event) = reply {
                said.push((id, event));
            }
        })
    }

    fn reports(&self) -> Vec<&TrainingReport> {
        reports(&self.said)
    }

    fn outcome(&self) -> Option<&TrainingOutcome> {
        outcome(&self.said)
    }
}

fn reports(said: &[(JobId, JobEvent)]) -> Vec<&TrainingReport> {
    said.iter()
        .filter_map(|(_, event)| match event {
            JobEvent::Training(report) => Some(report.as_ref()),
            _ => None,
        })
        .collect()
}

fn outcome(said: &[(JobId, JobEvent)]) -> Option<&TrainingOutcome> {
    said.iter().find_map(|(_, event)| match event {
        JobEvent::Trained(outcome) => Some(outcome.as_ref()),
        _ => None,
    })
}

/// Everything that is said of the usual training from its beginning to its end, which is run once for all tests that
/// compare others with it.
fn usual() -> &'static [(JobId, JobEvent)] {
    static SAID: OnceLock<Vec<(JobId, JobEvent)>> = OnceLock::new();
    SAID.get_or_init(|| {
        let mut bench = Bench::new();
        bench.start(1, order());
        // Every vote takes longer than the time between two words.
        while bench.turn(500.0) {}
        bench.said
    })
}

#[test]
fn the_table_of_stages_grows_and_at_the_end_there_is_a_detector() {
    let outcome = outcome(usual()).unwrap();
    assert!(outcome.judged == 6 && outcome.found >= 3, "{outcome:?}");
    assert!(outcome.sigmas.iter().all(|s| *s > 0.0 && *s < 5.0));
    let mut landmark = order().landmark;
    assert!(!landmark.is_trained());
    landmark.keep_trained_text(Some(&outcome.detector));
    assert!(landmark.is_trained() && landmark.trained_detector().is_some());

    let reports = reports(usual());
    let whole: Vec<usize> = reports.iter().map(|r| r.stages.len()).collect();
    assert!(whole.is_sorted() && whole[0] == 0, "{whole:?}");
    assert_eq!(whole.last(), Some(&outcome.stages.len()));
    assert!(outcome.stages.len() >= 2);
    let votes = |r: &&TrainingReport| r.growing.map(|row| (r.stages.len(), row.votes));
    let votes: Vec<_> = reports.iter().filter_map(votes).collect();
    assert!(votes.len() > 3 && votes.is_sorted(), "{votes:?}");
    let phases = [
        TrainingPhase::Photos,
        TrainingPhase::Mining,
        TrainingPhase::Voting,
        TrainingPhase::Judging,
    ];
    for phase in phases {
        assert!(reports.iter().any(|r| r.phase == phase), "{phase:?}");
    }
    assert!(reports.iter().map(|r| r.fraction).is_sorted());
    assert!(reports.iter().map(|r| r.seconds).is_sorted());
    // What can be gone on from is told once for every stage.
    let left = reports.iter().filter_map(|r| r.left.as_ref());
    let left: Vec<usize> = left.map(|l| l.stages.len()).collect();
    assert_eq!(left, (1..=outcome.stages.len()).collect::<Vec<_>>());
    assert_eq!(usual().last(), Some(&(1, JobEvent::Finished)));
}

#[test]
fn a_training_that_was_broken_off_goes_on_to_the_very_same_detector() {
    let mut first = Bench::new();
    first.start(1, order());
    let left = |bench: &Bench| bench.reports().iter().find_map(|r| r.left.clone());
    while left(&first).is_none() {
        assert!(first.turn(1.0));
    }
    first.ask(Request::Cancel(1));
    assert_eq!(first.said.last(), Some(&(1, JobEvent::Cancelled)));
    assert!(!first.runner.busy() && first.outcome().is_none());

    let mut second = Bench::new();
    let left = left(&first).unwrap();
    assert_eq!(left.stages.len(), 1);
    let before = left.seconds;
    second.start(
        2,
        TrainOrder {
            left: Some(left),
            ..order()
        },
    );
    while second.turn(1.0) {}
    let (expected, found) = (outcome(usual()).unwrap(), second.outcome().unwrap());
    assert_eq!(found.detector, expected.detector);
    assert_eq!(found.stages, expected.stages);
    assert!(found.seconds > before, "its time counts on");
    let told = second.reports();
    let told = told.iter().filter(|r| r.left.is_some()).count();
    assert_eq!(told, expected.stages.len() - 1, "the first stage was whole");
}

/// The first frames of the calm flight that show the landmark whole, with a box around it, and one without.
fn labelled(landmark: &Landmark) -> LabelledFrames {
    let source = FlightSource::Simulated(SimulationOptions {
        scenario: "distinct-400ft-calm".to_owned(),
        seed: 1,
        other_day: true,
        wind: None,
        height: None,
    });
    let flight = WorkerState::new(Abilities::WHOLE.opens)
        .flight(&source)
        .unwrap();
    let flight = flight.borrow().flight.clone();
    let size = (flight.camera.width as u32, flight.camera.height as u32);
    let truth = &flight.truth.as_ref().unwrap().frames;
    let in_picture = |index: usize| {
        let pose = truth[index].pose()?;
        let corners = landmark.bounds.corners().map(|corner| {
            let in_world = nalgebra::Point3::new(corner.north, corner.east, 0.0);
            flight.camera.project(&pose, &in_world)
        });
        let corners: Vec<_> = corners.into_iter().collect::<Option<_>>()?;
        let x = corners.iter().map(|p| p.x);
        let y = corners.iter().map(|p| p.y);
        let low = [
            x.clone().fold(f64::MAX, f64::min),
            y.clone().fold(f64::MAX, f64::min),
        ];
        let high = [x.fold(f64::MIN, f64::max), y.fold(f64::MIN, f64::max)];
        LabelBox::new(landmark.id, &landmark.name, [low, high], size).filter(|b| !b.truncated)
    };
    let frames = flight.frames.iter().enumerate();
    let mut labels: Vec<FrameLabels> = frames
        .filter_map(|(index, frame)| {
            Some(FrameLabels {
                frame: frame.name.clone(),
                size,
                boxes: vec![in_picture(index)?],
                ..FrameLabels::default()
            })
        })
        .take(3)
        .collect();
    labels.push(FrameLabels {
        frame: flight.frames.last().unwrap().name.clone(),
        size,
        absent: vec![landmark.id],
        ..FrameLabels::default()
    });
    LabelledFrames {
        flight: source,
        camera: FlownCamera::default(),
        labels,
    }
}

/// Photos of labelled frames of a flight whose focal length is stated so many times too long.
fn photos(labelled: LabelledFrames, focal: f64) -> Vec<TrainingPhoto> {
    let mut worker = WorkerState::new(Abilities::WHOLE.opens);
    let open = worker.flight(&labelled.flight).unwrap();
    std::sync::Arc::make_mut(&mut open.borrow_mut().flight)
        .camera
        .focal *= focal;
    let order = TrainOrder {
        labelled: Some(labelled),
        ..order()
    };
    let envelope = order.envelope();
    let mut train = Train::new(order, envelope);
    while train.read_labelled(&mut worker, &mut |_| {}).unwrap() {}
    train.labelled
}

#[test]
fn labelled_frames_are_turned_and_scaled_by_the_camera_that_the_mission_has_for_the_flight() {
    let labelled = labelled(&order().landmark);
    let seen = |photos: Vec<TrainingPhoto>| {
        let all = photos.into_iter();
        all.map(|photo| (photo.camera.focal, photo.around))
            .collect::<Vec<_>>()
    };
    let right = seen(photos(labelled.clone(), 1.0));
    assert_eq!(right.len(), 4);
    let mission = Scenario::named("distinct-400ft-calm").unwrap().mission();
    let by_mission = LabelledFrames {
        camera: FlownCamera::of(&Mission {
            camera: Some(Scenario::camera()),
            ..mission
        }),
        ..labelled.clone()
    };
    assert_eq!(seen(photos(by_mission, 2.0)), right);
    assert_ne!(seen(photos(labelled, 2.0)), right);
}

#[test]
fn a_picture_that_is_labelled_for_this_flight_and_for_none_is_learned_once() {
    let mut labelled = labelled(&order().landmark);
    let mut worker = WorkerState::new(Abilities::WHOLE.opens);
    let open = worker.flight(&labelled.flight).unwrap();
    let flight = open.borrow().flight.identity();
    let of_flight = |of: &FrameLabels| FrameLabels {
        flight: flight.clone(),
        ..of.clone()
    };
    let again: Vec<FrameLabels> = labelled.labels[1..].iter().map(of_flight).collect();
    labelled.labels.extend(again);
    assert_eq!(labelled.labels.len(), 7);
    assert_eq!(photos(labelled, 1.0).len(), 4);
}

#[test]
fn labelled_frames_are_learned_from_as_well() {
    let positives = |said: &[(JobId, JobEvent)]| {
        let words = said.iter().filter_map(|(_, event)| match event {
            JobEvent::Progress(_, words) => Some(words.clone()),
            _ => None,
        });
        let read = words.filter(|w| w.starts_with("Reading")).collect();
        let outcome = outcome(said).expect("a detector");
        (outcome.stages[0].row.positives, read)
    };
    let (without, none): (usize, Vec<String>) = positives(usual());
    assert!(none.is_empty());
    let mut bench = Bench::new();
    let labelled = Some(labelled(&order().landmark));
    bench.start(
        1,
        TrainOrder {
            labelled,
            ..order()
        },
    );
    while bench.turn(1.0) {}
    let (with, read) = positives(&bench.said);
    assert_eq!(with, without + 3 * order().plan.shown);
    // What follows at once is not told.
    assert_eq!(read[0], "Reading labelled frame 1 of 4");
}

#[test]
fn a_training_that_is_held_keeps_its_place_and_lets_others_work() {
    let mut bench = Bench::new();
    bench.start(1, order());
    while bench.reports().is_empty() {
        assert!(bench.turn(100.0));
    }
    bench.ask(Request::Hold(1, true));
    assert!(!bench.runner.busy(), "nothing is to be done");
    let before = bench.said.len();
    assert!(!bench.turn(100.0));
    assert_eq!(bench.said.len(), before);
    bench.start(2, order());
    bench.turn(500.0);
    assert!(bench.said[before..].iter().all(|(id, _)| *id == 2));
    bench.ask(Request::Cancel(2));
    bench.ask(Request::Hold(1, false));
    assert!(bench.turn(500.0));
    assert!(matches!(
        bench.said.last(),
        Some((1, JobEvent::Training(report))) if report.fraction > 0.0
    ));
}

#[test]
fn a_landmark_that_fits_into_no_picture_is_refused_in_words() {
    let mut order = order();
    let middle = order.landmark.bounds.center();
    let bounds = pilotage_core::frames::GroundRect::centered(middle, 900.0, 900.0);
    order.landmark.reshape(bounds);
    let mut bench = Bench::new();
    bench.start(1, order);
    while bench.turn(1.0) {}
    let Some((1, JobEvent::Failed(why))) = bench.said.last() else {
        panic!("{:?}", bench.said);
    };
    assert!(why.contains("smaller box") && why.ends_with('.'), "{why}");
}

#[test]
fn a_training_within_the_usual_envelope_is_the_usual_one_and_within_another_is_not() {
    let trained = |order: VariantOrder<TrainOrder>| {
        let mut events = crate::running::finished(order).into_iter();
        let found = events.find_map(|event| match event {
            JobEvent::Trained(outcome) => Some(outcome.detector),
            _ => None,
        });
        found.expect("a detector")
    };
    let envelope = order().envelope();
    let level = FlightEnvelope {
        tilt: 0.0,
        ..envelope.clone()
    };
    let plain = &outcome(usual()).unwrap().detector;
    assert_eq!(&trained(order().within(envelope)), plain);
    assert_ne!(&trained(order().within(level)), plain);
}

#[test]
fn what_looks_like_the_landmark_on_the_map_is_shown_as_well_wherever_one_trains() {
    // Two houses of one kind, 80 m from each other.
    let is_house = |x: usize, y: usize| (136..156).contains(&y) && matches!(x, 136..156 | 216..236);
    let grey = |x, y| if is_house(x, y) { 200 } else { 90 };
    let ground = Raster::from_fn(400, 300, |x, y| [grey(x, y), grey(x, y), grey(x, y), 255]);
    let place = GroundFromPixel::north_up(GroundPoint::new(146.0, -146.0), 1.0);
    let map = GeoreferencedPicture::new("two houses", ground, place).unwrap();
    let house = GroundRect::centered(GroundPoint::new(0.0, 0.0), 32.0, 32.0);
    let within = |look_alikes_within: f64| TrainOrder {
        landmark: Landmark::new(1, "house", house),
        look_alikes_within,
        ..order()
    };
    let found = within(100.0).look_alike(&map).unwrap();
    assert!(
        found.distance(&GroundPoint::new(0.0, 80.0)) < 3.0,
        "{found:?}"
    );
    assert_eq!(within(0.0).look_alike(&map), None);
    let order = within(100.0);
    let (_, Reads::Areas(areas)) = order.reads().unwrap() else {
        panic!("parts of the ground")
    };
    assert!(areas[0].contains(&found), "its ground is read beforehand");
}
