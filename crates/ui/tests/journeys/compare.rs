//! Runs and flights are kept, and compared with each other.

use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::{Job, JobEvent};
use pilotage_ui::host::OpenedFile;
use serde_json::Value;

use super::support::{Rig, rig};

fn errors(rig: &Rig) -> Vec<(String, Option<f64>)> {
    let state = rig.state();
    let rows = state["compare"]["errors"].as_array().expect("rows").iter();
    let row = |row: &Value| {
        let name = row["name"].as_str().unwrap_or_default().to_owned();
        (name, row["rms"].as_f64())
    };
    rows.map(row).collect()
}

fn names(rig: &Rig) -> Vec<String> {
    errors(rig).into_iter().map(|e| e.0).collect()
}

fn rig_with_a_kept_run() -> Rig {
    let mut rig = rig();
    rig.open_tab("Compare");
    rig.harness.get_by_label("Keep this run").click();
    rig.frames(3);
    rig
}

#[test]
fn the_run_is_compared_with_the_truth() {
    let mut rig = rig();
    rig.open_tab("Compare");
    let errors = errors(&rig);
    assert_eq!(errors[0], ("Truth".to_owned(), None));
    assert_eq!(errors[1].0, "This run");
    assert!(errors[1].1 > Some(0.0), "{errors:?}");
}

#[test]
fn another_trajectory_can_be_what_all_are_compared_with() {
    let mut rig = rig_with_a_kept_run();
    let kept = names(&rig).pop().expect("a kept run");
    let label = format!("Compare with {kept}");
    rig.harness.get_by_label(&label).click();
    rig.frames(3);
    let errors = errors(&rig);
    assert_eq!(errors.last(), Some(&(kept, None)));
    let same = errors.iter().find(|e| e.0 == "This run");
    assert_eq!(same.and_then(|e| e.1), Some(0.0), "{errors:?}");
}

#[test]
fn a_kept_run_stays_when_another_flight_is_flown_and_goes_when_it_is_let_go() {
    let mut rig = rig_with_a_kept_run();
    let kept = names(&rig).pop().expect("a kept run");
    rig.menu("Open", "Simulate a flight…");
    rig.frames(8);
    rig.harness.get_by_label("Fly").click();
    rig.settle();
    assert_eq!(names(&rig).last(), Some(&kept));
    rig.harness
        .get_by_label(&format!("Let go of {kept}"))
        .click();
    rig.frames(3);
    assert!(!names(&rig).contains(&kept));
}

#[test]
fn a_run_is_kept_smoothed_beside_the_one_in_flight() {
    let mut rig = rig();
    rig.open_tab("Compare");
    rig.harness.get_by_label("Keep it smoothed").click();
    rig.frames(3);
    let errors = errors(&rig);
    let (name, error) = errors.last().expect("a smoothed run");
    assert!(name.ends_with(", smoothed"), "{name}");
    let flown = errors.iter().find(|e| e.0 == "This run");
    assert_ne!(*error, flown.and_then(|e| e.1));
    assert!(error.is_some_and(f64::is_finite), "{errors:?}");
}

#[test]
fn every_estimator_flies_the_flight_and_stands_in_one_table() {
    let mut rig = rig();
    rig.open_tab("Compare");
    assert_eq!(rig.state()["compare"]["contest"], Value::Null);
    rig.harness.get_by_label("Fly by all estimators").click();
    rig.frames(3);
    let errors = rig.state()["compare"]["contest"].clone();
    assert_eq!(errors.as_array().map(Vec::len), Some(3), "{errors}");
    for name in ["UKF", "EKF", "PARTICLE"] {
        assert!(rig.harness.query_by_label(name).is_some(), "{name}");
    }
    rig.menu("Open", "Simulate a flight…");
    rig.frames(8);
    rig.harness.get_by_label("Fly").click();
    rig.settle();
    assert_eq!(
        rig.state()["compare"]["contest"],
        Value::Null,
        "another flight"
    );
}

#[test]
fn a_table_of_the_mission_before_says_so_and_why_an_estimator_failed() {
    let mut rig = rig();
    rig.open_tab("Compare");
    rig.host().left = Some(|job| matches!(job, Job::Contest(_)));
    rig.harness.get_by_label("Fly by all estimators").click();
    rig.frames(3);
    let is_contest = |(_, job): &&(u64, Job)| matches!(job, Job::Contest(_));
    let id = rig.host().jobs.iter().find(is_contest).expect("a job").0;
    let why = "Unscented Kalman filter: alpha is 0";
    let events = [JobEvent::Remark(why.to_owned()), JobEvent::Finished];
    rig.host().events.extend(events.map(|event| (id, event)));
    rig.frames(3);
    assert!(rig.harness.query_by_label(why).is_some());
    rig.host().left = None;
    rig.harness.get_by_label("Fly by all estimators").click();
    rig.frames(3);
    assert!(rig.harness.query_by_label(why).is_none());
    let told = |rig: &mut Rig| {
        rig.open_tab("Compare");
        let label = rig.harness.query_by_label_contains("Of the mission before");
        assert_eq!(rig.state()["compare"]["contest_of_before"], label.is_some());
        label.is_some()
    };
    assert!(!told(&mut rig));
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Switch Chapel off").click();
    rig.settle();
    assert!(told(&mut rig));
    rig.key_with(egui::Modifiers::COMMAND, egui::Key::Z);
    rig.settle();
    assert!(!told(&mut rig));
    assert!(rig.harness.query_by_label("Work it out again").is_none());
    rig.key_with(
        egui::Modifiers::COMMAND | egui::Modifiers::SHIFT,
        egui::Key::Z,
    );
    rig.settle();
    assert!(told(&mut rig));
    let count = |rig: &mut Rig| rig.host().jobs.iter().filter(is_contest).count();
    let before = count(&mut rig);
    rig.harness.get_by_label("Work it out again").click();
    rig.frames(3);
    assert_eq!(count(&mut rig), before + 1);
    rig.settle();
    assert!(!told(&mut rig));
}

#[test]
fn a_kept_run_is_hidden_on_the_map() {
    let mut rig = rig_with_a_kept_run();
    let kept = names(&rig).pop().expect("a kept run");
    rig.harness
        .get_by_label(&format!("{kept} on the map"))
        .click();
    rig.frames(3);
    assert_eq!(rig.state()["compare"]["kept"][0]["shown"], false);
}

#[test]
fn the_column_keeps_its_width() {
    let mut rig = rig_with_a_kept_run();
    let left = |rig: &Rig| rig.harness.get_by_label("Keep this run").rect().left();
    let before = left(&rig);
    rig.frames(10);
    assert_eq!(left(&rig), before);
}

#[test]
fn a_run_that_is_being_smoothed_tells_how_far_it_is_and_can_be_stopped() {
    let mut rig = rig();
    rig.host().left = Some(|job| matches!(job, Job::Smooth(_)));
    rig.open_tab("Compare");
    rig.harness.get_by_label("Keep it smoothed").click();
    rig.frames(4);
    assert!(rig.harness.query_by_label("Keep it smoothed").is_none());
    let is_smoothing = |(_, job): &&(u64, Job)| matches!(job, Job::Smooth(_));
    let jobs = &rig.host().jobs;
    let id = jobs.iter().find(is_smoothing).expect("a job").0;
    let told = JobEvent::Progress(0.4, "Smoothing the run".to_owned());
    rig.host().events.push((id, told));
    rig.frames(3);
    rig.harness.get_by_label("Smoothing the run: 40 %");
    rig.harness.get_by_label("Stop").click();
    rig.frames(3);
    assert_eq!(rig.host().cancelled, [id]);
    rig.harness.get_by_label("Keep it smoothed");
}

#[test]
fn a_contest_under_way_can_be_stopped_after_a_run_was_smoothed() {
    let mut rig = rig();
    rig.host().left = Some(|job| matches!(job, Job::Contest(_)));
    rig.open_tab("Compare");
    rig.harness.get_by_label("Fly by all estimators").click();
    rig.frames(4);
    let is_contest = |(_, job): &&(u64, Job)| matches!(job, Job::Contest(_));
    let contest = rig
        .host()
        .jobs
        .iter()
        .find(is_contest)
        .expect("a contest")
        .0;
    rig.harness.get_by_label("Keep it smoothed").click();
    rig.settle();
    assert!(names(&rig).iter().any(|name| name.ends_with(", smoothed")));
    rig.key_with(egui::Modifiers::COMMAND, egui::Key::K);
    rig.harness
        .event(egui::Event::Text("stop computing".into()));
    rig.frames(2);
    rig.key(egui::Key::Enter);
    assert_eq!(rig.host().cancelled, [contest]);
}

#[test]
fn stop_beside_a_computation_stops_that_one_alone() {
    let mut rig = rig();
    rig.host().left = Some(|job| matches!(job, Job::Contest(_) | Job::Fly(_)));
    rig.open_tab("Compare");
    rig.harness.get_by_label("Fly by all estimators").click();
    rig.frames(4);
    rig.open_tab("GPS outage");
    rig.harness.get_by_label("Cut 60 s from here").click();
    rig.frames(4);
    rig.key(egui::Key::R);
    rig.frames(3);
    assert!(!rig.state()["job"].is_null(), "a flight is under way");
    let id_of = |rig: &mut Rig, is_it: fn(&Job) -> bool| {
        let jobs = &rig.host().jobs;
        let found = jobs.iter().rev().find(|(_, job)| is_it(job));
        found.expect("a job").0
    };
    let outage = id_of(&mut rig, |job| matches!(job, Job::Outage(_)));
    let contest = id_of(&mut rig, |job| matches!(job, Job::Contest(_)));
    rig.harness.get_by_label("Stop").click();
    rig.frames(3);
    assert_eq!(rig.host().cancelled, [outage]);
    rig.open_tab("Compare");
    rig.harness.get_by_label("Stop").click();
    rig.frames(3);
    assert_eq!(rig.host().cancelled, [outage, contest]);
}

#[test]
fn stop_in_the_top_bar_stops_the_work_of_which_it_tells() {
    let mut rig = rig();
    rig.host().left = Some(|job| matches!(job, Job::Contest(_)));
    rig.open_tab("Compare");
    rig.harness.get_by_label("Fly by all estimators").click();
    rig.frames(4);
    rig.host().opened.push(vec![OpenedFile {
        path: "large.tif".into(),
        content: vec![7; 3].into(),
    }]);
    rig.frames(3);
    assert_eq!(rig.state()["job"]["words"], "Opening large.tif");
    rig.harness.get_by_label("Stop computing").click();
    rig.frames(3);
    let opening = rig.host().jobs.iter().rev();
    let opening = opening.clone().find(|(_, job)| matches!(job, Job::Open(_)));
    let opening = opening.expect("files are looked at").0;
    assert_eq!(rig.host().cancelled, [opening]);
}
