use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::{
    EvaluationReport, ExplainOrder, ExplainedBy, FileContent, Job, JobEvent, JobId, OpenedFiles,
};
use pilotage_ui::host::OpenedFile;

use super::plan::set;
use super::support::flight::mission;
use super::support::{Rig, rig};

/// Searches of trained detectors asked for so far.
fn asked(rig: &mut Rig) -> usize {
    let of_detector = |job: &Job| match job {
        Job::ExplainMatch(ExplainOrder { by, .. }) => *by == ExplainedBy::Cascade,
        _ => false,
    };
    let jobs = &rig.host().jobs;
    jobs.iter().filter(|(_, job)| of_detector(job)).count()
}

/// Opens the mission with something trained for each landmark.
fn open_trained(rig: &mut Rig) {
    let mut trained = mission();
    for landmark in &mut trained.landmarks {
        let b = landmark.bounds;
        let text = format!(
            "{{\"bounds\":{{\"south\":{},\"north\":{},\"west\":{},\"east\":{}}}}}",
            b.south, b.north, b.west, b.east
        );
        let name = "trained_detector".to_owned();
        landmark.properties.insert(name, text);
    }
    rig.host().opens = Some(OpenedFiles {
        key: String::new(),
        log: None,
        flight: None,
        map: None,
        terrain: None,
        mission: Some(trained),
        run: None,
        unplaced: None,
        photos: Vec::new(),
        imports: Vec::new(),
        tables: Vec::new(),
        labels: None,
        beside: None,
        remarks: Vec::new(),
    });
    let content = FileContent::Bytes([].into());
    let path = "trained.geojson".to_owned();
    rig.host().opened.push(vec![OpenedFile { path, content }]);
    rig.settle();
}

#[test]
fn the_detector_tab_says_to_train_one_and_then_asks_what_it_saw_but_not_again_and_again() {
    let mut rig = rig();
    rig.key(Key::End);
    rig.key(Key::Z);
    rig.frames(3);
    assert_eq!(rig.state()["side_tab"], "detector");
    rig.harness
        .get_by_label_contains("No detector was trained for");
    assert_eq!(asked(&mut rig), 0);
    open_trained(&mut rig);
    rig.frames(6);
    let once = asked(&mut rig);
    assert!(once > 0);
    rig.frames(20);
    assert_eq!(asked(&mut rig), once, "asked once for each run");
    let shown = rig.state()["detector"]["shown"].clone();
    assert_eq!(shown["trouble"], "the picture is gone");
    rig.harness.get_by_label("the picture is gone");
    // Another frame is another search.
    for _ in 0..40 {
        rig.key(Key::ArrowLeft);
    }
    rig.frames(4);
    let elsewhere = asked(&mut rig);
    assert!(elsewhere > once);
    // In another run of the flight it may have seen something else.
    rig.key(Key::R);
    rig.settle();
    assert!(asked(&mut rig) > elsewhere);
}

#[test]
fn stages_are_stepped_through_from_anywhere_in_replay() {
    let mut rig = rig();
    rig.open_tab("Filter");
    rig.key_with(Modifiers::SHIFT, Key::Z);
    assert_eq!(rig.state()["side_tab"], "detector");
    rig.open_tab("Filter");
    rig.key(Key::Comma);
    assert_eq!(rig.state()["side_tab"], "detector");
}

/// Gives the command to evaluate a detector; the jobs that were asked for so far.
fn evaluate(rig: &mut Rig) -> Vec<JobId> {
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.harness
        .event(egui::Event::Text("evaluate on days".into()));
    rig.key(Key::Enter);
    rig.frames(2);
    let jobs = rig.host().jobs.iter();
    let jobs = jobs.filter(|(_, job)| matches!(job, Job::Evaluate(_)));
    jobs.map(|(id, _)| *id).collect()
}

/// Gives the first landmark another name.
fn rename(rig: &mut Rig, name: &str) {
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Barn").click();
    rig.frames(3);
    rig.harness
        .get_by_label("Name of the selected landmark")
        .focus();
    rig.key_with(Modifiers::COMMAND, Key::A);
    rig.harness.event(egui::Event::Text(name.into()));
    rig.key(Key::Enter);
    rig.frames(2);
    assert_eq!(rig.state()["landmarks"][0]["name"], name);
    rig.key(Key::Escape);
    rig.frames(2);
}

#[test]
fn a_detector_is_evaluated_once_and_what_came_of_it_goes_with_the_flight() {
    let mut rig = rig();
    assert!(evaluate(&mut rig).is_empty(), "there is no detector");
    rig.key(Key::Escape);
    assert_eq!(rig.state()["detector"]["evaluation"]["open"], false);
    open_trained(&mut rig);
    let jobs = evaluate(&mut rig);
    let [job] = *jobs else {
        panic!("{jobs:?} were asked for");
    };
    let progress = JobEvent::Progress(0.5, "Day 10 of 20".to_owned());
    rig.host().events.push((job, progress));
    rig.frames(2);
    let evaluation = rig.state()["detector"]["evaluation"].clone();
    assert_eq!(evaluation["open"], true);
    assert_eq!(evaluation["progress"]["words"], "Day 10 of 20");
    let report = EvaluationReport {
        landmark: 1,
        name: "Barn".to_owned(),
        figures: vec!["9 of 10 found".to_owned()],
        basis: String::new(),
        plots: Vec::new(),
        csv: String::new(),
        is_partial: false,
    };
    let report = JobEvent::Evaluation(Box::new(report));
    let events = [report, JobEvent::Finished].map(|event| (job, event));
    rig.host().events.extend(events);
    rig.frames(2);
    let evaluation = rig.state()["detector"]["evaluation"].clone();
    assert_eq!(evaluation["whole"], true);
    assert_eq!(evaluation["progress"], serde_json::Value::Null);
    rig.harness.get_by_label("9 of 10 found");
    rig.key(Key::Escape);
    rig.frames(2);
    assert_eq!(rig.state()["detector"]["evaluation"]["open"], false);
    assert_eq!(evaluate(&mut rig), [job], "it is known");
    rig.key(Key::Escape);
    rig.frames(2);
    rename(&mut rig, "Old barn");
    assert_eq!(evaluate(&mut rig), [job], "a name is no reason");
    rig.key(Key::Escape);
    rig.frames(2);
    // With another tilt of the camera it is not.
    rig.open_tab("Plan");
    rig.harness.get_by_label("Filter settings").click();
    rig.frames(3);
    set(&mut rig, "Camera tilt σ", 3.0);
    assert_eq!(rig.state()["detector"]["evaluation"]["whole"], true);
    rig.key(Key::Escape);
    rig.frames(2);
    assert_eq!(evaluate(&mut rig).len(), 2, "it is judged anew");
    assert_eq!(rig.state()["detector"]["evaluation"]["whole"], false);
    rig.key(Key::Escape);
    rig.frames(2);
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.harness.event(egui::Event::Text("demo".into()));
    rig.key(Key::Enter);
    rig.settle();
    assert_eq!(rig.state()["detector"]["evaluation"]["whole"], false);
}
