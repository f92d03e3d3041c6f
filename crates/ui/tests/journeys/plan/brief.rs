use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::{FINE, Job, JobEvent, JobId};

use super::super::support::Rig;
use super::{choose, draw, planning, set};

#[test]
fn the_brief_of_a_route_is_printed_with_its_legs_landmarks_and_prediction() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (60.0, 0.0), (0.0, 300.0)]);
    rig.key_with(Modifiers::COMMAND, Key::P);
    rig.settle();
    let (style, body) = rig.host().printed.take().expect("a page");
    assert!(style.contains("@page"), "{style}");
    for words in [
        "Route 1",
        "Predicted error",
        "largest error (1σ)",
        "Legs",
        "Landmarks",
        "Wind from",
    ] {
        assert!(body.contains(words), "{words}");
    }
}

#[test]
fn without_a_route_there_is_nothing_to_print() {
    let mut rig = planning();
    rig.key_with(Modifiers::COMMAND, Key::P);
    rig.settle();
    assert!(rig.host().printed.is_none());
}

/// Jobs for pictures of briefs so far.
fn asked(rig: &mut Rig) -> Vec<JobId> {
    let jobs = rig.host().jobs.iter();
    let pictures = jobs.filter(|(_, job)| matches!(job, Job::Brief(_)));
    pictures.map(|(id, _)| *id).collect()
}

/// Route 2 after a route 1 whose brief was asked for, while its pictures are not there yet.
fn printing() -> Rig {
    let mut rig = planning();
    draw(&mut rig, &[(100.0, -300.0), (100.0, 300.0)]);
    draw(&mut rig, &[(-100.0, -300.0), (-100.0, 300.0)]);
    rig.host().left = Some(|job| matches!(job, Job::Brief(_)));
    rig.harness.get_by_label("Route 1").click();
    rig.settle();
    rig.key_with(Modifiers::COMMAND, Key::P);
    rig.settle();
    assert_eq!(asked(&mut rig).len(), 1);
    rig
}

/// Hands over the pictures of a brief.
fn deliver(rig: &mut Rig, job: JobId) {
    let pictures = JobEvent::BriefPictures(Box::default());
    rig.host().events.push((job, pictures));
    rig.host().events.push((job, JobEvent::Finished));
    rig.settle();
}

#[test]
fn a_brief_is_not_printed_of_a_route_that_was_selected_while_its_pictures_were_made() {
    let mut rig = printing();
    rig.harness.get_by_label("Route 2").click();
    rig.settle();
    let job = asked(&mut rig)[0];
    assert!(rig.host().cancelled.contains(&job));
    deliver(&mut rig, job);
    assert!(rig.host().printed.is_none());
    assert_eq!(asked(&mut rig).len(), 1);
}

#[test]
fn pictures_of_a_brief_are_made_anew_where_its_plan_is_another_one_since() {
    let mut rig = printing();
    choose(&mut rig, 1);
    set(&mut rig, "Altitude of the way-point", 205.0);
    let before = asked(&mut rig)[0];
    deliver(&mut rig, before);
    assert!(rig.host().printed.is_none());
    let jobs = asked(&mut rig);
    assert_eq!(jobs.len(), 2);
    deliver(&mut rig, jobs[1]);
    let (_, body) = rig.host().printed.take().expect("a page");
    assert!(body.contains("Route 1") && body.contains("205 m"), "{body}");
}

#[test]
fn a_brief_waits_for_the_prediction_with_all_worlds() {
    let mut rig = planning();
    draw(&mut rig, &[(100.0, -300.0), (100.0, 300.0)]);
    rig.host().left = Some(|job| matches!(job, Job::Predict(order) if order.worlds == FINE));
    choose(&mut rig, 1);
    set(&mut rig, "Altitude of the way-point", 205.0);
    assert_eq!(rig.state()["plan"]["prediction"]["fine"], false);
    rig.key_with(Modifiers::COMMAND, Key::P);
    rig.settle();
    assert!(rig.host().printed.is_none() && asked(&mut rig).is_empty());
    rig.host().left = None;
    set(&mut rig, "Altitude of the way-point", 206.0);
    rig.settle();
    assert_eq!(rig.state()["plan"]["prediction"]["fine"], true);
    assert!(rig.host().printed.is_some());
}
