//! Jobs from beginning to end on the calling thread.

use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::imagery::Window;
use pilotage_core::simulate::Scenario;

use super::*;
use crate::{
    AssessmentOrder, FlightSource, FlyOrder, MapSource, ProposeOrder, Share, ShareOrder,
    SimulationOptions, SumUpOrder, TileOrder,
};

fn fly(scenario: &str) -> Job {
    Job::Fly(FlyOrder {
        flight: FlightSource::Simulated(SimulationOptions {
            scenario: scenario.to_owned(),
            seed: 1,
            other_day: true,
            wind: None,
            height: None,
        }),
        map: MapSource::world("countryside"),
        mission: None,
    })
}

/// Events until `enough` of them have come or the jobs are done.
fn until(host: &mut InlineWorkers, enough: impl Fn(&[JobEvent]) -> bool) -> Vec<JobEvent> {
    let mut seen = Vec::new();
    while host.busy() && !enough(&seen) {
        seen.extend(host.events().into_iter().map(|(_, event)| event));
    }
    seen
}

fn steps(events: &[JobEvent]) -> usize {
    let count = |e: &JobEvent| match e {
        JobEvent::Steps(steps) => steps.len(),
        _ => 0,
    };
    events.iter().map(count).sum()
}

#[test]
fn a_flight_tells_its_head_first_and_then_streams_steps_and_pictures() {
    let mut host = InlineWorkers::new();
    let id = host.start(fly("distinct-400ft-wind"));
    let seen = until(&mut host, |seen| steps(seen) > 25);
    let kinds: Vec<_> = seen
        .iter()
        .filter(|e| !matches!(e, JobEvent::Progress(..)))
        .take(4)
        .collect();
    assert!(
        matches!(
            kinds[..],
            [
                JobEvent::Flight(_),
                JobEvent::Mission(_),
                JobEvent::RunStarted(_),
                JobEvent::FrameTaken { index: 0, .. }
            ]
        ),
        "{kinds:?}"
    );
    host.cancel(id);
    assert_eq!(host.events(), [(id, JobEvent::Cancelled)]);
    assert!(!host.busy());
}

#[test]
fn a_mission_that_was_given_is_not_told_again() {
    let mut host = InlineWorkers::new();
    let Job::Fly(FlyOrder { flight, map, .. }) = fly("distinct-400ft-calm") else {
        panic!("a flight");
    };
    let mission = Some(Scenario::all()[0].mission());
    host.start(Job::Fly(FlyOrder {
        flight,
        map,
        mission,
    }));
    let seen = until(&mut host, |seen| steps(seen) > 0);
    assert!(!seen.iter().any(|e| matches!(e, JobEvent::Mission(_))));
}

#[test]
fn a_tile_asked_for_during_a_flight_comes_before_the_flight_goes_on() {
    let mut host = InlineWorkers::new();
    host.start(fly("distinct-400ft-calm"));
    until(&mut host, |seen| steps(seen) > 0);
    let window = Window::covering(
        &GroundRect::centered(GroundPoint::new(0.0, 0.0), 50.0, 50.0),
        1.0,
    );
    let tile = host.start(Job::Tile(TileOrder {
        map: MapSource::world("countryside"),
        window,
    }));
    let events = host.events();
    let expected = |(id, event): &(JobId, JobEvent)| {
        *id == tile && matches!(event, JobEvent::Tile { window: w, .. } if *w == window)
    };
    assert!(events.iter().any(expected));
    assert!(events.iter().all(|(id, _)| *id == tile));
}

#[test]
fn an_unknown_scenario_is_refused_with_the_names_of_those_there_are() {
    let mut host = InlineWorkers::new();
    host.start(fly("distinct-to-the-moon"));
    let seen = until(&mut host, |_| false);
    let Some(JobEvent::Failed(text)) = seen.last() else {
        panic!("{seen:?}");
    };
    assert!(text.contains("distinct-to-the-moon") && text.contains("distinct-400ft-calm"));
}

/// Runs a job to its end and returns its events.
fn run(host: &mut InlineWorkers, job: Job) -> Vec<JobEvent> {
    host.start(job);
    host.finish_jobs();
    host.events().into_iter().map(|(_, event)| event).collect()
}

/// A landmark to be measured.
fn measured() -> Box<AssessmentOrder> {
    let scenario = Scenario::named("distinct-400ft-calm").unwrap();
    let mission = scenario.mission();
    Box::new(AssessmentOrder {
        map: MapSource::world("countryside"),
        landmark: mission.landmarks[0].clone(),
        camera: Scenario::camera(),
        height: scenario.height,
        navigator: mission.navigator,
        ground_down: 0.0,
        seed: AssessmentOrder::SEED,
    })
}

/// Assessment of a landmark, measured as one job or in two shares.
fn measure(shares: usize) -> crate::Assessment {
    let order = measured();
    let mut host = InlineWorkers::new();
    let mut views = Vec::new();
    let last = if shares == 1 {
        Job::Assess(order)
    } else {
        for part in 0..shares {
            let job = Job::AssessShare(ShareOrder(order.clone(), Share { part, of: shares }));
            for event in run(&mut host, job) {
                if let JobEvent::Views(mut some) = event {
                    views.append(&mut some);
                }
            }
        }
        views.sort_by_key(|(look, _)| *look);
        Job::SumUp(SumUpOrder(
            order,
            views.iter().map(|(_, view)| *view).collect(),
        ))
    };
    let events = run(&mut host, last).into_iter();
    let mut found = events.filter_map(|event| match event {
        JobEvent::Assessment(found) => Some(*found),
        _ => None,
    });
    found.next().unwrap()
}

#[test]
fn a_measurement_in_two_shares_says_the_very_same() {
    assert_eq!(measure(2), measure(1));
}

#[test]
fn of_a_landmark_that_does_not_fit_into_a_picture_the_kind_of_failure_is_told_beside_its_words() {
    let mut order = measured();
    // A camera of 45° sees 100 m from 120 m.
    order.landmark.bounds = GroundRect::centered(order.landmark.bounds.center(), 600.0, 600.0);
    let words = format!("{}.", order.misfit());
    let share = Share { part: 1, of: 2 };
    for job in [
        Job::Assess(order.clone()),
        Job::AssessShare(ShareOrder(order, share)),
    ] {
        let events = run(&mut InlineWorkers::new(), job);
        let end = &events[events.len() - 2..];
        assert_eq!(end, [JobEvent::Misfit, JobEvent::Failed(words.clone())]);
    }
}

/// Landmarks proposed for a short leg, as one job or in two shares.
fn propose(shares: usize) -> Vec<pilotage_core::plan::Suggestion> {
    use crate::SuggestOrder;
    use pilotage_core::frames::GroundPoint;
    use pilotage_core::plan::{FieldView, Proposal};
    use pilotage_core::simulate::{Scenario, SensorSpec};
    let scenario = Scenario::named("distinct-400ft-calm").unwrap();
    let navigator = scenario.navigator(&SensorSpec::default());
    let order = Box::new(SuggestOrder {
        map: MapSource::world("countryside"),
        view: FieldView {
            camera: Scenario::camera(),
            height: scenario.height,
            position: Proposal::POSITION,
            tilt: 0.02,
        },
        way_points: vec![GroundPoint::new(0.0, 0.0), GroundPoint::new(-120.0, 90.0)],
        speed: 19.0,
        ground_down: 0.0,
        navigator,
        taken: Vec::new(),
        count: 4,
        side: None,
        seed: SuggestOrder::SEED,
    });
    let mut host = InlineWorkers::new();
    let last = if shares == 1 {
        Job::Suggest(order)
    } else {
        let mut found = Vec::new();
        for part in 0..shares {
            let job = Job::SuggestShare(ShareOrder(order.clone(), Share { part, of: shares }));
            for event in run(&mut host, job) {
                if let JobEvent::Candidates(of, mut some) = event {
                    assert_eq!(of, part);
                    assert!(!some.is_empty(), "nothing passed in share {part}");
                    found.append(&mut some);
                }
            }
        }
        Job::Propose(ProposeOrder(order, found))
    };
    let events = run(&mut host, last).into_iter();
    let mut found = events.filter_map(|event| match event {
        JobEvent::Suggestions(found) => Some(found),
        _ => None,
    });
    found.next().unwrap()
}

#[test]
fn a_proposal_in_two_shares_says_the_very_same() {
    let whole = propose(1);
    assert_eq!(whole.len(), 4);
    assert_eq!(propose(2), whole);
}
