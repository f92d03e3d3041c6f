use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::{FlightSource, FlyOrder, Job, RehearseOrder};

use super::{draw, number, planning, set};
use crate::support::Rig;

/// A plan with a route, rehearsed by that many flights without pictures.
fn rehearsed(flights: f64) -> Rig {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, 0.0), (260.0, 0.0)]);
    rig.harness
        .get_by_label("Settings of the rehearsal")
        .click();
    rig.frames(3);
    set(&mut rig, "Flights of a rehearsal", flights);
    rig.harness.get_by_label("with pictures").click();
    rig.frames(2);
    rig.key(Key::Escape);
    rig.harness.get_by_label("Rehearse this route").click();
    rig.settle();
    rig
}

fn last_flight(rig: &Rig) -> FlyOrder {
    let jobs = rig.harness.state().host.jobs.iter().rev();
    let mut flights = jobs.filter_map(|(_, job)| match job {
        Job::Fly(order) => Some(order.clone()),
        _ => None,
    });
    flights.next().expect("a flight")
}

#[test]
fn a_route_is_rehearsed_and_errors_are_told_until_the_plan_changes() {
    let mut rig = rehearsed(3.0);
    assert_eq!(number(&rig, "/rehearsal/flown"), 3.0);
    assert_eq!(rig.state()["plan"]["rehearsal"]["current"], true);
    let orders: Vec<&RehearseOrder> = (rig.harness.state().host.jobs.iter())
        .filter_map(|(_, job)| match job {
            Job::Rehearse(order) => Some(&**order),
            _ => None,
        })
        .collect();
    let seeds: Vec<u64> = orders.iter().map(|order| order.seed).collect();
    assert_eq!(seeds, [1, 2, 3]);
    assert!(
        orders
            .iter()
            .all(|it| it.as_stated && it.plan.worlds == 100)
    );
    let error = number(&rig, "/rehearsal/worst/error");
    let rms = number(&rig, "/rehearsal/rms");
    assert!(rms > 0.0 && rms < error, "{rms} m, at most {error} m");
    let share = number(&rig, "/rehearsal/inside_corridor");
    assert!((0.0..=1.0).contains(&share), "{share}");
    rig.harness
        .get_by_label_contains("3 flights, without pictures");
    draw(&mut rig, &[(0.0, 0.0), (200.0, 90.0)]);
    assert_eq!(rig.state()["plan"]["rehearsal"]["current"], false);
    rig.harness
        .get_by_label_contains("The plan has changed since");
}

#[test]
fn what_a_landmark_is_called_and_what_is_noted_of_it_changes_no_prediction_and_no_rehearsal() {
    let mut rig = rehearsed(2.0);
    let jobs = rig.host().jobs.len();
    rig.harness.get_by_label("Landmarks").click();
    rig.frames(3);
    rig.harness
        .get_by(|n| n.label().is_some_and(|l| l.starts_with("Barn: ")))
        .click();
    rig.settle();
    let field = "Name of the selected landmark";
    rig.harness.get_by_label(field).focus();
    rig.frames(2);
    rig.key_with(Modifiers::COMMAND, Key::A);
    rig.harness.event(egui::Event::Text("Silo".into()));
    rig.key(Key::Enter);
    rig.harness.get_by_label("Category").focus();
    rig.frames(2);
    rig.harness.event(egui::Event::Text("building".into()));
    rig.key(Key::Enter);
    rig.settle();
    let landmarks = rig.state()["landmarks"].clone();
    let words = format!("{landmarks}");
    assert!(words.contains("Silo"), "{words}");
    let later = rig.host().jobs[jobs..].iter();
    let planned = later.filter(|(_, job)| matches!(job, Job::Predict(_) | Job::Rehearse(_)));
    assert_eq!(planned.count(), 0);
    assert_eq!(rig.state()["plan"]["rehearsal"]["current"], true);
    // And what was predicted is told by the names of the mission.
    rig.harness.get_by_label("Route").click();
    rig.frames(3);
    rig.harness.get_by(|n| {
        n.value()
            .is_some_and(|v| v.starts_with("Largest error: ") && v.ends_with(" from Chapel."))
    });
}

#[test]
fn a_rehearsal_that_waits_for_its_prediction_is_of_no_route_that_is_selected_meanwhile() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, 0.0), (260.0, 0.0)]);
    rig.host().left = Some(|job| matches!(job, Job::Predict(_)));
    draw(&mut rig, &[(0.0, 200.0), (260.0, 200.0)]);
    rig.harness.get_by_label("Rehearse this route").click();
    rig.frames(3);
    rig.harness.get_by_label("Route 1").click();
    rig.host().left = None;
    rig.settle();
    rig.harness
        .get_by_label_contains("The route is not rehearsed");
    let rehearsed = |(_, job): &(_, Job)| matches!(job, Job::Rehearse(_));
    assert!(!rig.host().jobs.iter().any(rehearsed));
}

#[test]
fn the_worst_flight_of_a_rehearsal_is_watched_in_replay_with_the_mission_that_is_open() {
    let mut rig = rehearsed(3.0);
    let worst = number(&rig, "/rehearsal/worst/seed") as u64;
    rig.harness.get_by_label_contains("Watch the worst").click();
    rig.frames(3);
    let flown = last_flight(&rig);
    let FlightSource::Rehearsed(flight) = &flown.flight else {
        panic!("{:?}", flown.flight);
    };
    assert_eq!((flight.seed, &flight.map), (worst, &flown.map));
    assert_eq!(flight.path.way_points.len(), 2);
    let mission = flown.mission.as_ref().expect("the mission that is open");
    assert_eq!(mission.routes.len(), 1);
    assert_eq!(rig.state()["workspace"], "Replay");
    rig.settle();
    let title = rig.state()["title"].as_str().map(str::to_owned);
    assert!(
        title.as_ref().is_some_and(|it| it.contains("rehearsal")),
        "{title:?}"
    );
}

#[test]
fn the_selected_route_is_the_first_choice_of_what_to_simulate() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, 0.0), (260.0, 0.0)]);
    let name = rig.state()["plan"]["routes"][0]["name"]
        .as_str()
        .expect("a name")
        .to_owned();
    rig.key(Key::M);
    rig.frames(2);
    rig.harness
        .get_by_role_and_label(egui::accesskit::Role::RadioButton, &name)
        .click();
    rig.frames(2);
    rig.harness.get_by_label("Fly").click();
    rig.frames(3);
    assert!(matches!(
        last_flight(&rig).flight,
        FlightSource::Rehearsed(_)
    ));
    assert_eq!(rig.state()["workspace"], "Replay");
}
