//! The pool and its workers, tested with lines that only take notes.

use std::cell::RefCell;
use std::rc::Rc;

use pilotage_core::plan::LandmarkCandidate;

use super::{WorkerPool, WorkerPort};
use crate::FlightSource;
use crate::{
    AssessmentOrder, COARSE, DescribeMapOrder, EncodedPicture, FlyOrder, FramePictureOrder, Job,
    JobEvent, JobId, LetGoOrder, MapSource, PictureForm, PlannedPath, PredictionOrder,
    ProposeOrder, ProvideOrder, ReadLogOrder, Reply, Request, SimulationOptions, SuggestOrder,
    WEB_TILES,
};

#[derive(Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "a test keeps a handful of them")]
enum Note {
    Opened(usize),
    Sent(usize, Request),
    Closed(usize),
}

/// Places of the whole program.
const WHOLE_FLIES: usize = 3;
const WHOLE_SHOWS: usize = 4;
const WHOLE_ANSWERS: usize = 5;

type Notes = Rc<RefCell<Vec<Note>>>;

struct NotingPort(usize, Notes);

impl WorkerPort for NotingPort {
    fn send(&mut self, request: &Request) {
        self.1
            .borrow_mut()
            .push(Note::Sent(self.0, request.clone()));
    }

    fn close(&mut self) {
        self.1.borrow_mut().push(Note::Closed(self.0));
    }
}

fn worker_pool() -> (WorkerPool<NotingPort>, Notes) {
    let notes = Notes::default();
    let line = notes.clone();
    let worker_pool = WorkerPool::new(move |seat, _| {
        line.borrow_mut().push(Note::Opened(seat));
        NotingPort(seat, line.clone())
    });
    (worker_pool, notes)
}

fn fly() -> Job {
    Job::Fly(FlyOrder {
        flight: FlightSource::Simulated(SimulationOptions {
            scenario: "any".to_owned(),
            seed: 1,
            other_day: false,
            wind: None,
            height: None,
        }),
        map: MapSource::world("countryside"),
        mission: None,
    })
}

fn provide() -> Job {
    Job::Provide(ProvideOrder {
        key: "flight".to_owned(),
        files: vec![("flight.json".to_owned(), vec![1, 2, 3].into())],
    })
}

fn describe_files() -> Job {
    Job::DescribeMap(DescribeMapOrder(MapSource::Files("flight".to_owned())))
}

fn sent_to(notes: &Notes, seat: usize) -> Vec<Request> {
    notes
        .borrow()
        .iter()
        .filter_map(|note| match note {
            Note::Sent(s, request) if *s == seat => Some(request.clone()),
            _ => None,
        })
        .collect()
}

#[test]
fn a_picture_is_decoded_where_least_waits() {
    let (mut worker_pool, notes) = worker_pool();
    worker_pool.warm_up();
    let decode = || {
        Job::FramePicture(FramePictureOrder {
            flight: FlightSource::Simulated(SimulationOptions::demo()),
            index: 3,
            form: PictureForm::PixelsOf(EncodedPicture(vec![1, 2, 3])),
        })
    };
    let (first, second) = (worker_pool.start(decode()), worker_pool.start(decode()));
    assert_eq!(sent_to(&notes, 2), [Request::Start(first, decode())]);
    assert_eq!(sent_to(&notes, 1), [Request::Start(second, decode())]);
}

#[test]
fn a_question_does_not_wait_behind_a_flight() {
    let (mut worker_pool, notes) = worker_pool();
    let flight = worker_pool.start(fly());
    let question = worker_pool.start(Job::DescribeMap(DescribeMapOrder(MapSource::world(
        "countryside",
    ))));
    assert_eq!(sent_to(&notes, 0), [Request::Start(flight, fly())]);
    let asked = Request::Start(
        question,
        Job::DescribeMap(DescribeMapOrder(MapSource::world("countryside"))),
    );
    assert_eq!(sent_to(&notes, 1), [asked]);
}

#[test]
fn files_reach_a_worker_once_before_the_first_job_that_names_them() {
    let (mut worker_pool, notes) = worker_pool();
    worker_pool.start(provide());
    assert!(notes.borrow().is_empty(), "nobody needs them yet");
    let first = worker_pool.start(describe_files());
    let second = worker_pool.start(describe_files());
    let expected = [
        Request::Start(0, provide()),
        Request::Start(first, describe_files()),
        Request::Start(second, describe_files()),
    ];
    assert_eq!(sent_to(&notes, WHOLE_SHOWS), expected);
}

#[test]
fn a_new_worker_gets_the_files_and_the_interrupted_job_again() {
    let (mut worker_pool, notes) = worker_pool();
    worker_pool.start(provide());
    let id = worker_pool.start(describe_files());
    worker_pool.take_events();
    worker_pool.worker_died(WHOLE_SHOWS);
    let again = [
        Request::Start(0, provide()),
        Request::Start(id, describe_files()),
    ];
    assert_eq!(sent_to(&notes, WHOLE_SHOWS)[2..], again);
    assert_eq!(worker_pool.take_lost(), 1);
    assert!(matches!(worker_pool.take_events()[..], [(job, JobEvent::Progress(..))] if job == id));
}

#[test]
fn a_new_worker_gets_the_tiles_of_the_interrupted_job_again() {
    let (mut worker_pool, notes) = worker_pool();
    let tile = || vec![("https://tiles/17/1/2.png".to_owned(), vec![7; 3].into())];
    let tiles = || {
        Job::Provide(ProvideOrder {
            key: WEB_TILES.to_owned(),
            files: tile(),
        })
    };
    let id = worker_pool.reserve();
    worker_pool.begin(id, describe_files(), tile());
    let first = [
        Request::Start(0, tiles()),
        Request::Start(id, describe_files()),
    ];
    assert_eq!(sent_to(&notes, WHOLE_SHOWS), first);
    worker_pool.worker_died(WHOLE_SHOWS);
    assert_eq!(sent_to(&notes, WHOLE_SHOWS)[2..], first);
    // Once it is over, they are kept no more, and the next one brings its own.
    worker_pool.receive(WHOLE_SHOWS, Reply::Event(id, JobEvent::Finished));
    assert!(worker_pool.tiles.is_empty());
    let next = worker_pool.reserve();
    worker_pool.begin(next, describe_files(), tile());
    assert_eq!(sent_to(&notes, WHOLE_SHOWS)[4], first[0]);
}

#[test]
fn every_worker_that_shares_a_job_gets_its_tiles_once() {
    let (mut worker_pool, notes) = worker_pool();
    let id = worker_pool.reserve();
    let tile = ("https://tiles/17/1/2.png".to_owned(), vec![7; 3].into());
    worker_pool.begin(id, Job::Assess(Box::new(order())), vec![tile]);
    let given = |seat| {
        let is_tiles = |it: &Request| matches!(it, Request::Start(0, Job::Provide(_)));
        sent_to(&notes, seat)
            .iter()
            .filter(|it| is_tiles(it))
            .count()
    };
    let seats = [WHOLE_FLIES, WHOLE_SHOWS];
    assert_eq!(seats.map(given), [1, 1]);
    worker_pool.worker_died(WHOLE_SHOWS);
    assert_eq!(seats.map(given), [1, 2]);
}

#[test]
fn a_job_whose_worker_dies_three_times_fails_and_says_that_what_is_open_stays() {
    let (mut worker_pool, _) = worker_pool();
    let id = worker_pool.start(fly());
    for _ in 0..3 {
        worker_pool.worker_died(0);
    }
    let events = worker_pool.take_events();
    let Some((job, JobEvent::Failed(text))) = events.last() else {
        panic!("{events:?}");
    };
    assert_eq!(*job, id);
    assert!(text.contains("still here"), "{text}");
}

#[test]
fn a_worker_that_does_not_answer_is_replaced() {
    let (mut worker_pool, notes) = worker_pool();
    let id = worker_pool.start(fly());
    let replaced: Vec<bool> = (0..150)
        .map(|n| worker_pool.tick(500.0 * f64::from(n)))
        .collect();
    assert_eq!(replaced.iter().filter(|r| **r).count(), 1, "{replaced:?}");
    assert!(notes.borrow().contains(&Note::Closed(0)));
    let begun = sent_to(&notes, 0);
    let begun = begun
        .iter()
        .filter(|r| matches!(r, Request::Start(i, _) if *i == id));
    assert_eq!(begun.count(), 2);
}

#[test]
fn a_worker_that_answers_late_but_answers_stays() {
    let (mut worker_pool, _) = worker_pool();
    worker_pool.start(fly());
    for n in 0..600 {
        let now = 500.0 * f64::from(n);
        assert!(!worker_pool.tick(now), "replaced at {now} ms");
        if n % 50 == 49 {
            worker_pool.receive(0, Reply::Alive);
        }
    }
}

#[test]
fn a_page_that_slept_does_not_accuse_its_workers() {
    let (mut worker_pool, _) = worker_pool();
    worker_pool.start(fly());
    assert!(!worker_pool.tick(0.0));
    assert!(
        !worker_pool.tick(3_600_000.0),
        "an hour passed between two ticks"
    );
}

#[test]
fn what_a_worker_says_of_a_job_that_ended_is_not_heard() {
    let (mut worker_pool, _) = worker_pool();
    let id = worker_pool.start(fly());
    worker_pool.receive(0, Reply::Event(id, JobEvent::Finished));
    worker_pool.receive(
        0,
        Reply::Event(id, JobEvent::Progress(0.5, "late".to_owned())),
    );
    assert_eq!(worker_pool.take_events(), [(id, JobEvent::Finished)]);
}

#[test]
fn workers_that_have_nothing_to_do_end_with_what_was_open_and_begin_again_when_needed() {
    let (mut worker_pool, notes) = worker_pool();
    worker_pool.start(provide());
    let id = worker_pool.start(describe_files());
    worker_pool.receive(WHOLE_SHOWS, Reply::Event(id, JobEvent::Finished));
    let flight = worker_pool.start(fly());
    worker_pool.let_go(&["flight".to_owned()].into());
    assert!(
        notes.borrow().contains(&Note::Closed(WHOLE_SHOWS)),
        "it was idle"
    );
    assert!(!notes.borrow().contains(&Note::Closed(0)), "it flies");
    worker_pool.receive(0, Reply::Event(flight, JobEvent::Cancelled));
    assert!(notes.borrow().contains(&Note::Closed(0)), "it has flown");
    assert_eq!(worker_pool.take_lost(), 0);
    // The files in use are given to the new one.
    let again = worker_pool.start(describe_files());
    let expected = [
        Request::Start(0, provide()),
        Request::Start(again, describe_files()),
    ];
    assert_eq!(sent_to(&notes, WHOLE_SHOWS)[2..], expected);
}

#[test]
fn the_worker_that_has_read_the_log_in_use_stays_to_be_asked_about_it() {
    let (mut worker_pool, notes) = worker_pool();
    let read = |key: &str| {
        Job::ReadLog(ReadLogOrder {
            key: key.to_owned(),
            file: "flight.bin".to_owned(),
        })
    };
    let id = worker_pool.start(read("drop"));
    worker_pool.receive(WHOLE_FLIES, Reply::Event(id, JobEvent::Finished));
    worker_pool.let_go(&["drop".to_owned()].into());
    let id = worker_pool.start(fly());
    worker_pool.receive(WHOLE_FLIES, Reply::Event(id, JobEvent::Finished));
    assert!(
        !notes.borrow().contains(&Note::Closed(WHOLE_FLIES)),
        "it has the log"
    );
    let keys = vec!["drop".to_owned()];
    let told = Request::Start(0, Job::LetGo(LetGoOrder { keys }));
    assert!(sent_to(&notes, WHOLE_FLIES).contains(&told));
    worker_pool.let_go(&["another".to_owned()].into());
    assert!(
        notes.borrow().contains(&Note::Closed(WHOLE_FLIES)),
        "nobody asks"
    );
}

#[test]
fn a_worker_with_a_new_job_stays_without_the_files_that_nobody_needs() {
    let (mut worker_pool, notes) = worker_pool();
    worker_pool.start(provide());
    let id = worker_pool.start(describe_files());
    worker_pool.let_go(&std::collections::BTreeSet::new());
    let next = worker_pool.start(Job::DescribeMap(DescribeMapOrder(MapSource::world(
        "countryside",
    ))));
    for id in [id, next] {
        worker_pool.receive(WHOLE_SHOWS, Reply::Event(id, JobEvent::Finished));
    }
    assert!(!notes.borrow().contains(&Note::Closed(WHOLE_SHOWS)));
    let told = Request::Start(0, Job::LetGo(LetGoOrder { keys: Vec::new() }));
    assert!(sent_to(&notes, WHOLE_SHOWS).contains(&told));
    let sent = sent_to(&notes, WHOLE_SHOWS).len();
    worker_pool.start(describe_files());
    assert_eq!(
        sent_to(&notes, WHOLE_SHOWS).len(),
        sent + 1,
        "the files are gone"
    );
}

/// A landmark to measure, the workers that share it, and the numbers of their shares.
fn measured() -> (WorkerPool<NotingPort>, Notes, JobId, [JobId; 2]) {
    let (mut worker_pool, notes) = worker_pool();
    let id = worker_pool.start(Job::Assess(Box::new(order())));
    let shares = [WHOLE_FLIES, WHOLE_SHOWS].map(|seat| match sent_to(&notes, seat)[..] {
        [Request::Start(share, Job::AssessShare(_))] => share,
        _ => panic!("{:?}", notes.borrow()),
    });
    (worker_pool, notes, id, shares)
}

fn order() -> AssessmentOrder {
    let scenario = pilotage_core::simulate::Scenario::named("distinct-400ft-calm").unwrap();
    let mission = scenario.mission();
    AssessmentOrder {
        map: MapSource::world("countryside"),
        landmark: mission.landmarks[0].clone(),
        camera: pilotage_core::simulate::Scenario::camera(),
        height: scenario.height,
        navigator: mission.navigator,
        ground_down: 0.0,
        seed: AssessmentOrder::SEED,
    }
}

fn progress(event: &JobEvent) -> f32 {
    match event {
        JobEvent::Progress(share, _) => *share,
        other => panic!("{other:?}"),
    }
}

#[test]
fn two_workers_share_a_measurement_and_tell_of_it_as_one() {
    let (mut worker_pool, notes, id, [even, odd]) = measured();
    let done = |share| JobEvent::Progress(share, "View".to_owned());
    worker_pool.receive(WHOLE_FLIES, Reply::Event(even, done(0.5)));
    worker_pool.receive(WHOLE_SHOWS, Reply::Event(odd, done(0.25)));
    let told = worker_pool.take_events();
    assert!(told.iter().all(|(of, _)| *of == id), "{told:?}");
    assert_eq!(progress(&told[0].1), 0.25);
    assert_eq!(progress(&told[1].1), 0.375);
    for (seat, share) in [(WHOLE_SHOWS, odd), (WHOLE_FLIES, even)] {
        worker_pool.receive(seat, Reply::Event(share, JobEvent::Views(Vec::new())));
        worker_pool.receive(seat, Reply::Event(share, JobEvent::Finished));
    }
    assert!(
        worker_pool.take_events().is_empty(),
        "the result is not there yet"
    );
    let Some(Request::Start(sum, Job::SumUp(_))) = sent_to(&notes, WHOLE_FLIES).pop() else {
        panic!("{:?}", notes.borrow());
    };
    worker_pool.receive(WHOLE_FLIES, Reply::Event(sum, JobEvent::Finished));
    assert_eq!(worker_pool.take_events(), [(id, JobEvent::Finished)]);
}

#[test]
fn a_shared_measurement_is_cancelled_as_one_and_fails_as_one() {
    let (mut worker_pool, notes, id, [even, odd]) = measured();
    worker_pool.cancel(id);
    assert!(sent_to(&notes, WHOLE_FLIES).contains(&Request::Cancel(even)));
    assert!(sent_to(&notes, WHOLE_SHOWS).contains(&Request::Cancel(odd)));
    worker_pool.receive(WHOLE_FLIES, Reply::Event(even, JobEvent::Cancelled));
    assert!(worker_pool.take_events().is_empty());
    worker_pool.receive(WHOLE_SHOWS, Reply::Event(odd, JobEvent::Cancelled));
    assert_eq!(worker_pool.take_events(), [(id, JobEvent::Cancelled)]);

    let (mut worker_pool, notes, id, [even, odd]) = measured();
    let failed = || JobEvent::Failed("too large.".to_owned());
    worker_pool.receive(WHOLE_FLIES, Reply::Event(even, failed()));
    assert_eq!(worker_pool.take_events(), [(id, failed())]);
    assert!(sent_to(&notes, WHOLE_SHOWS).contains(&Request::Cancel(odd)));
    // The other share failed in the same moment, before it heard that it is to stop.
    worker_pool.receive(WHOLE_SHOWS, Reply::Event(odd, JobEvent::Views(Vec::new())));
    worker_pool.receive(WHOLE_SHOWS, Reply::Event(odd, failed()));
    assert_eq!(worker_pool.take_events(), [], "it was told once");
    worker_pool.let_go(&std::collections::BTreeSet::new());
    assert!(
        notes.borrow().contains(&Note::Closed(WHOLE_SHOWS)),
        "it has nothing to do"
    );
}

#[test]
fn a_coarse_prediction_does_not_wait_behind_a_whole_one() {
    let predict = |worlds| {
        let of = order();
        Job::Predict(Box::new(PredictionOrder {
            path: PlannedPath::level(Vec::new(), of.height, of.camera),
            navigator: of.navigator,
            landmarks: Vec::new(),
            worlds,
            seed: PredictionOrder::SEED,
            limit: f64::INFINITY,
        }))
    };
    let (mut worker_pool, notes) = worker_pool();
    let coarse = worker_pool.start(predict(COARSE));
    assert_eq!(sent_to(&notes, 2).len(), 1);
    worker_pool.receive(2, Reply::Event(coarse, JobEvent::Finished));
    let fine = worker_pool.start(predict(100));
    worker_pool.cancel(fine);
    worker_pool.start(predict(COARSE));
    assert_eq!(
        sent_to(&notes, 1).len(),
        1,
        "the whole one may not stop yet"
    );
    assert_eq!(sent_to(&notes, 2).len(), 3);
}

#[test]
fn two_workers_share_a_proposal_and_a_third_job_chooses() {
    let of = order();
    let asked = SuggestOrder {
        map: MapSource::world("countryside"),
        view: pilotage_core::plan::FieldView {
            camera: of.camera,
            height: of.height,
            position: 10.0,
            tilt: 0.02,
        },
        way_points: Vec::new(),
        speed: 19.0,
        ground_down: 0.0,
        navigator: of.navigator,
        taken: Vec::new(),
        count: 3,
        side: None,
        seed: SuggestOrder::SEED,
    };
    let (mut worker_pool, notes) = worker_pool();
    let id = worker_pool.start(Job::Suggest(Box::new(asked)));
    let shares = [WHOLE_FLIES, WHOLE_SHOWS].map(|seat| match sent_to(&notes, seat)[..] {
        [Request::Start(share, Job::SuggestShare(_))] => share,
        _ => panic!("{:?}", notes.borrow()),
    });
    let place = |score| LandmarkCandidate {
        bounds: of.landmark.bounds,
        score,
        rival: 0.0,
        rival_place: pilotage_core::frames::GroundPoint::default(),
        margin: 1.0,
        drift: 0.0,
        probability: 1.0,
        range: [1.0; 2],
    };
    // The second share is done first; its places come last all the same.
    for (part, seat) in [(1, WHOLE_SHOWS), (0, WHOLE_FLIES)] {
        let places = vec![place(part as f64)];
        worker_pool.receive(
            seat,
            Reply::Event(shares[part], JobEvent::Candidates(part, places)),
        );
        worker_pool.receive(seat, Reply::Event(shares[part], JobEvent::Finished));
    }
    assert!(
        worker_pool.take_events().is_empty(),
        "nothing is chosen yet"
    );
    let Some(Request::Start(last, Job::Propose(ProposeOrder(_, found)))) =
        sent_to(&notes, WHOLE_FLIES).pop()
    else {
        panic!("{:?}", notes.borrow());
    };
    assert_eq!(found, [place(0.0), place(1.0)]);
    let chosen = JobEvent::Suggestions(Vec::new());
    worker_pool.receive(WHOLE_FLIES, Reply::Event(last, chosen.clone()));
    worker_pool.receive(WHOLE_FLIES, Reply::Event(last, JobEvent::Finished));
    assert_eq!(
        worker_pool.take_events(),
        [(id, chosen), (id, JobEvent::Finished)]
    );
}

#[path = "worker_pool_program_tests.rs"]
mod programs;

#[path = "worker_pool_training_tests.rs"]
mod trainings;
