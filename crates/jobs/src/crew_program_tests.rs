//! The program that the crew opens for a job, and jobs that wait for each other.

use super::*;
use crate::{DescribeMapOrder, MakeFlightOrder, Program};

#[test]
fn the_small_program_flies_and_the_whole_one_is_opened_by_the_first_job_that_needs_it() {
    let opened = Rc::new(RefCell::new(Vec::new()));
    let (list, notes) = (opened.clone(), Notes::default());
    let mut crew = Crew::new(move |seat, program| {
        list.borrow_mut().push((seat, program));
        NotingPort(seat, notes.clone())
    });
    crew.start(fly());
    crew.start(Job::DescribeMap(DescribeMapOrder(MapSource::Scenery)));
    assert_eq!(
        *opened.borrow(),
        [(0, Program::Flying), (1, Program::Flying)]
    );
    crew.start(provide());
    crew.start(describe_files());
    assert_eq!(opened.borrow()[2..], [(4, Program::Whole)]);
}

#[test]
fn a_small_job_goes_to_the_whole_program_where_only_that_is_there() {
    let (mut crew, notes) = crew();
    crew.start(provide());
    crew.start(describe_files());
    let scenery = || Job::DescribeMap(DescribeMapOrder(MapSource::Scenery));
    let id = crew.start(scenery());
    assert_eq!(
        sent_to(&notes, WHOLE_SHOWS).last(),
        Some(&Request::Start(id, scenery()))
    );
    assert!(!notes.borrow().contains(&Note::Opened(1)));
}

#[test]
fn a_flight_waits_for_a_more_urgent_job_that_the_other_program_does_in_its_role() {
    let (mut crew, notes) = crew();
    let flight = crew.start(fly());
    let make = |key: &str| {
        Job::MakeFlight(MakeFlightOrder {
            key: key.to_owned(),
        })
    };
    let urgent = crew.start(make("a"));
    let after = |seat| sent_to(&notes, seat).last().cloned();
    assert_eq!(after(0), Some(Request::Hold(flight, true)), "it waits");
    crew.receive(WHOLE_FLIES, Reply::Event(urgent, JobEvent::Finished));
    assert_eq!(after(0), Some(Request::Hold(flight, false)), "it goes on");
    // One that the user holds is held after the wait as well, and nothing waits for a held one.
    crew.hold(flight, true);
    let urgent = crew.start(make("b"));
    crew.receive(WHOLE_FLIES, Reply::Event(urgent, JobEvent::Finished));
    assert_eq!(after(0), Some(Request::Hold(flight, true)));
    crew.hold(flight, false);
    let urgent = crew.start(make("c"));
    crew.hold(urgent, true);
    assert_eq!(after(0), Some(Request::Hold(flight, false)));
    // A worker that dies leaves nobody waiting for it.
    crew.hold(urgent, false);
    assert_eq!(after(0), Some(Request::Hold(flight, true)));
    for _ in 0..3 {
        crew.worker_died(WHOLE_FLIES);
    }
    assert_eq!(after(0), Some(Request::Hold(flight, false)));
}
