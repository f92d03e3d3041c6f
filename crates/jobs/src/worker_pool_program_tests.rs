//! The program that the pool opens for a job, and jobs that wait for each other.

use super::*;
use crate::{DescribeMapOrder, MakeFlightOrder, Program};

#[test]
fn the_small_program_flies_and_the_whole_one_is_opened_by_the_first_job_that_needs_it() {
    let opened = Rc::new(RefCell::new(Vec::new()));
    let (list, notes) = (opened.clone(), Notes::default());
    let mut worker_pool = WorkerPool::new(move |seat, program| {
        list.borrow_mut().push((seat, program));
        NotingPort(seat, notes.clone())
    });
    worker_pool.start(fly());
    worker_pool.start(Job::DescribeMap(DescribeMapOrder(MapSource::world(
        "countryside",
    ))));
    assert_eq!(
        *opened.borrow(),
        [(0, Program::Flying), (1, Program::Flying)]
    );
    worker_pool.start(provide());
    worker_pool.start(describe_files());
    assert_eq!(opened.borrow()[2..], [(4, Program::Whole)]);
}

#[test]
fn a_small_job_goes_to_the_whole_program_where_only_that_is_there() {
    let (mut worker_pool, notes) = worker_pool();
    worker_pool.start(provide());
    worker_pool.start(describe_files());
    let scenery = || Job::DescribeMap(DescribeMapOrder(MapSource::world("countryside")));
    let id = worker_pool.start(scenery());
    assert_eq!(
        sent_to(&notes, WHOLE_SHOWS).last(),
        Some(&Request::Start(id, scenery()))
    );
    assert!(!notes.borrow().contains(&Note::Opened(1)));
}

#[test]
fn a_flight_waits_for_a_more_urgent_job_that_the_other_program_does_in_its_role() {
    let (mut worker_pool, notes) = worker_pool();
    let flight = worker_pool.start(fly());
    let make = |key: &str| {
        Job::MakeFlight(MakeFlightOrder {
            key: key.to_owned(),
        })
    };
    let urgent = worker_pool.start(make("a"));
    let after = |seat| sent_to(&notes, seat).last().cloned();
    assert_eq!(after(0), Some(Request::Hold(flight, true)), "it waits");
    worker_pool.receive(WHOLE_FLIES, Reply::Event(urgent, JobEvent::Finished));
    assert_eq!(after(0), Some(Request::Hold(flight, false)), "it goes on");
    // One that the user holds is held after the wait as well, and nothing waits for a held one.
    worker_pool.hold(flight, true);
    let urgent = worker_pool.start(make("b"));
    worker_pool.receive(WHOLE_FLIES, Reply::Event(urgent, JobEvent::Finished));
    assert_eq!(after(0), Some(Request::Hold(flight, true)));
    worker_pool.hold(flight, false);
    let urgent = worker_pool.start(make("c"));
    worker_pool.hold(urgent, true);
    assert_eq!(after(0), Some(Request::Hold(flight, false)));
    // A worker that dies leaves nobody waiting for it.
    worker_pool.hold(urgent, false);
    assert_eq!(after(0), Some(Request::Hold(flight, true)));
    for _ in 0..3 {
        worker_pool.worker_died(WHOLE_FLIES);
    }
    assert_eq!(after(0), Some(Request::Hold(flight, false)));
}
