//! What the crew does with its workers, with lines that only take notes.

use std::cell::RefCell;
use std::rc::Rc;

use super::{Crew, WorkerPort};
use crate::jobs::FlightSource;
use crate::jobs::{Job, JobEvent, MapSource, Reply, Request, SimulationOptions};

#[derive(Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "a test keeps a handful of them")]
enum Note {
    Opened(usize),
    Sent(usize, Request),
    Closed(usize),
}

type Notes = Rc<RefCell<Vec<Note>>>;

struct NotingPort(usize, Notes);

impl WorkerPort for NotingPort {
    fn send(&mut self, request: Request) {
        self.1.borrow_mut().push(Note::Sent(self.0, request));
    }

    fn close(&mut self) {
        self.1.borrow_mut().push(Note::Closed(self.0));
    }
}

fn crew() -> (Crew<NotingPort>, Notes) {
    let notes = Notes::default();
    let line = notes.clone();
    let crew = Crew::new(move |seat| {
        line.borrow_mut().push(Note::Opened(seat));
        NotingPort(seat, line.clone())
    });
    (crew, notes)
}

fn fly() -> Job {
    Job::Fly {
        flight: FlightSource::Simulated(SimulationOptions {
            scenario: "any".to_owned(),
            seed: 1,
            other_day: false,
            wind: None,
            height: None,
        }),
        map: MapSource::Scenery,
        mission: None,
    }
}

fn provide() -> Job {
    Job::Provide {
        key: "flight".to_owned(),
        files: vec![("flight.json".to_owned(), vec![1, 2, 3].into())],
    }
}

fn describe_files() -> Job {
    Job::DescribeMap(MapSource::Files("flight".to_owned()))
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
fn a_question_does_not_wait_behind_a_flight() {
    let (mut crew, notes) = crew();
    let flight = crew.start(fly());
    let question = crew.start(Job::DescribeMap(MapSource::Scenery));
    assert_eq!(sent_to(&notes, 0), [Request::Start(flight, fly())]);
    let asked = Request::Start(question, Job::DescribeMap(MapSource::Scenery));
    assert_eq!(sent_to(&notes, 1), [asked]);
}

#[test]
fn files_reach_a_worker_once_before_the_first_job_that_names_them() {
    let (mut crew, notes) = crew();
    crew.start(provide());
    assert!(notes.borrow().is_empty(), "nobody needs them yet");
    let first = crew.start(describe_files());
    let second = crew.start(describe_files());
    let expected = [
        Request::Start(0, provide()),
        Request::Start(first, describe_files()),
        Request::Start(second, describe_files()),
    ];
    assert_eq!(sent_to(&notes, 1), expected);
}

#[test]
fn a_new_worker_gets_the_files_and_the_interrupted_job_again() {
    let (mut crew, notes) = crew();
    crew.start(provide());
    let id = crew.start(describe_files());
    crew.take_events();
    crew.worker_died(1);
    let again = [
        Request::Start(0, provide()),
        Request::Start(id, describe_files()),
    ];
    assert_eq!(sent_to(&notes, 1)[2..], again);
    assert_eq!(crew.take_lost(), 1);
    assert!(matches!(crew.take_events()[..], [(job, JobEvent::Progress(..))] if job == id));
}

#[test]
fn a_job_whose_worker_dies_three_times_fails_and_says_that_documents_are_safe() {
    let (mut crew, _) = crew();
    let id = crew.start(fly());
    for _ in 0..3 {
        crew.worker_died(0);
    }
    let events = crew.take_events();
    let Some((job, JobEvent::Failed(text))) = events.last() else {
        panic!("{events:?}");
    };
    assert_eq!(*job, id);
    assert!(text.contains("documents are safe"), "{text}");
}

#[test]
fn a_worker_that_does_not_answer_is_replaced() {
    let (mut crew, notes) = crew();
    let id = crew.start(fly());
    let replaced: Vec<bool> = (0..150).map(|n| crew.tick(500.0 * f64::from(n))).collect();
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
    let (mut crew, _) = crew();
    crew.start(fly());
    for n in 0..600 {
        let now = 500.0 * f64::from(n);
        assert!(!crew.tick(now), "replaced at {now} ms");
        if n % 50 == 49 {
            crew.receive(0, Reply::Alive);
        }
    }
}

#[test]
fn a_page_that_slept_does_not_accuse_its_workers() {
    let (mut crew, _) = crew();
    crew.start(fly());
    assert!(!crew.tick(0.0));
    assert!(!crew.tick(3_600_000.0), "an hour passed between two ticks");
}

#[test]
fn what_a_worker_says_of_a_job_that_ended_is_not_heard() {
    let (mut crew, _) = crew();
    let id = crew.start(fly());
    crew.receive(0, Reply::Event(id, JobEvent::Finished));
    crew.receive(
        0,
        Reply::Event(id, JobEvent::Progress(0.5, "late".to_owned())),
    );
    assert_eq!(crew.take_events(), [(id, JobEvent::Finished)]);
}
