use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::Job;

use super::{choose, draw, planning, set};
use crate::support::Rig;

fn suggested(rig: &Rig) -> Vec<bool> {
    let state = rig.state();
    let list = state["plan"]["suggested"]["list"].as_array().cloned();
    let list = list.expect("a list");
    list.iter().map(|s| s["added"] == true).collect()
}

fn landmarks(rig: &Rig) -> usize {
    rig.state()["landmarks"].as_array().map_or(0, Vec::len)
}

#[test]
fn suggested_landmarks_are_listed_with_a_reason_added_in_one_step_and_taken_back_in_one() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    rig.open_tab("Landmarks");
    rig.harness
        .get_by_label("Suggest 6 landmarks for this route")
        .click();
    rig.settle();
    let jobs = &rig.harness.state().host.jobs;
    let order = jobs.iter().rev().find_map(|(_, job)| match job {
        Job::Suggest(order) => Some(order.clone()),
        _ => None,
    });
    let order = order.expect("a job");
    assert_eq!((order.way_points.len(), order.count), (2, 6));
    assert_eq!(
        order.taken.len(),
        4,
        "nothing is proposed over what is there"
    );
    assert_eq!(suggested(&rig), [false, false]);
    rig.harness
        .get_by_label_contains("1  saves 9\u{a0}s · found 70\u{a0}% · look-alike 0.30");
    let before = landmarks(&rig);
    rig.harness.get_by_label("Add all").click();
    rig.settle();
    assert_eq!(landmarks(&rig), before + 2);
    assert_eq!(suggested(&rig), [true, true]);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(landmarks(&rig), before);
    assert_eq!(suggested(&rig), [false, false]);
}

#[test]
fn one_of_the_suggestions_is_added_alone_with_its_reason_as_a_note() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    let label = "Suggest 6 landmarks for the map";
    rig.harness.get_by_label(label).click();
    rig.settle();
    rig.harness.get_by_label("Add suggestion 2").click();
    rig.settle();
    assert_eq!(suggested(&rig), [false, true]);
    let state = rig.state();
    let last = state["landmarks"]
        .as_array()
        .and_then(|l| l.last().cloned());
    let last = last.expect("a landmark");
    assert_eq!(last["name"], "Suggestion 5");
    assert!(last["notes"].as_str().is_some_and(|n| n.contains("0.50")));
    rig.harness.get_by_label("Dismiss").click();
    rig.settle();
    assert!(suggested(&rig).is_empty());
    assert!(rig.harness.query_by_label("Add all").is_none());
}

#[test]
fn suggestions_for_another_height_say_so() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    rig.open_tab("Landmarks");
    rig.harness
        .get_by_label("Suggest 6 landmarks for this route")
        .click();
    rig.settle();
    let since = "The plan has changed since";
    rig.harness.get_by_label("Add suggestion 2").click();
    rig.settle();
    assert!(rig.harness.query_by_label_contains(since).is_none());
    rig.open_tab("Route");
    choose(&mut rig, 1);
    set(&mut rig, "Altitude of the way-point", 400.0);
    rig.open_tab("Landmarks");
    rig.settle();
    rig.harness.get_by_label_contains(since);
}
