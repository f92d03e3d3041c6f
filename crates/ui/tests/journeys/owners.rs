//! Answers of jobs that nobody waits for: told as a fault, whoever owns the job.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_core::frames::Geodetic;
use pilotage_core::imagery::terrain::HeightDatum;
use pilotage_jobs::{Job, JobEvent, OpenedFiles, TerrainInfo};
use pilotage_ui::host::OpenedFile;
use pilotage_ui::job_owners::JobOwner;

use super::log::eastward;
use super::plan::draw;
use super::reopen::nothing;
use super::support::{Rig, ScriptedHost, rig, rig_on};

/// Titles of notices about faults of the program.
fn faults(rig: &Rig) -> Vec<String> {
    let state = rig.state_at_fault();
    let toasts = state["toasts"].as_array().expect("a list").iter();
    let faults = toasts.filter(|toast| {
        let text = toast["text"].as_str();
        text.is_some_and(|text| text.ends_with("This is a fault of the program."))
    });
    faults.map(|toast| toast["title"].to_string()).collect()
}

#[test]
fn an_answer_of_a_job_that_nobody_started_is_told() {
    let mut rig = rig();
    rig.host().events.push((9_999, JobEvent::Finished));
    rig.frames(3);
    assert_eq!(faults(&rig), ["\"An answer was not used\""]);
}

#[test]
fn an_answer_for_which_its_owner_does_not_wait_is_told() {
    let mut rig = rig();
    let host = rig.host();
    host.owners.own(9_999, JobOwner::Feature("photos"));
    host.events.push((9_999, JobEvent::Places(Vec::new())));
    rig.frames(3);
    assert_eq!(faults(&rig), ["\"An answer was not used\""]);
}

/// Faults that are told once a job that was asked for answers by what its owner does not know; `None` if it was not.
fn faults_of_strange_answer(is_it: IsIt, ask: Deed) -> Option<Vec<String>> {
    let host = ScriptedHost {
        left: Some(is_it),
        ..ScriptedHost::default()
    };
    let mut rig = rig_on(host, egui::vec2(1440.0, 900.0));
    ask(&mut rig);
    rig.frames(3);
    let host = rig.host();
    let jobs = host
        .jobs
        .iter()
        .filter(|(id, _)| !host.cancelled.contains(id));
    let (job, _) = *jobs.rev().find(|(_, job)| is_it(job))?;
    host.events.push((job, JobEvent::Places(Vec::new())));
    rig.frames(3);
    Some(faults(&rig))
}

fn open_a_file(rig: &mut Rig) {
    rig.host().opened.push(vec![OpenedFile {
        path: "a.txt".to_owned(),
        content: vec![1].into(),
    }]);
}

fn open_heights(rig: &mut Rig) {
    rig.host().opens = Some(OpenedFiles {
        terrain: Some(TerrainInfo {
            name: "ridge.tif".into(),
            datum: HeightDatum::MeanSeaLevel("EGM96".into()),
            spacing: 10.0,
            middle: Geodetic::from_degrees(45.0, -30.0, 0.0),
        }),
        ..nothing()
    });
    open_a_file(rig);
    rig.settle();
}

/// Question whether a job is of some kind.
type IsIt = fn(&Job) -> bool;

/// Something that people do.
type Deed = fn(&mut Rig);

#[test]
fn an_answer_of_a_kind_that_its_owner_does_not_know_is_told() {
    let none: Deed = |_| {};
    let cut: Deed = |rig| {
        rig.open_tab("GPS outage");
        let strip = rig.rect("/timeline");
        let at = |share: f32| egui::pos2(strip.left() + share * strip.width(), strip.center().y);
        rig.drag_with(Modifiers::SHIFT, at(0.4), at(0.6));
        rig.frames(3);
        rig.harness.get_by_label_contains("Cut GPS from").click();
    };
    let save: Deed = |rig| rig.key_with(Modifiers::COMMAND, Key::S);
    let explain: Deed = |rig| {
        rig.key(Key::End);
        rig.open_tab("Match");
        rig.frames(6);
    };
    let compare: Deed = |rig| {
        rig.open_tab("Compare");
        rig.harness.get_by_label("Fly by all estimators").click();
    };
    let smooth: Deed = |rig| {
        rig.open_tab("Compare");
        rig.harness.get_by_label("Keep it smoothed").click();
    };
    let heat: Deed = |rig| {
        rig.open_tab("Plan");
        rig.settle();
        rig.key(Key::H);
        rig.settle();
    };
    let route: Deed = |rig| {
        rig.open_tab("Plan");
        rig.settle();
        draw(rig, &[(0.0, -300.0), (0.0, 300.0)]);
    };
    let suggest: Deed = |rig| {
        rig.open_tab("Plan");
        rig.settle();
        rig.open_tab("Landmarks");
        let label = "Suggest 6 landmarks for the map";
        rig.harness.get_by_label(label).click();
        rig.frames(3);
    };
    let log: Deed = |rig| {
        rig.host().really_open = true;
        rig.host().opened.push(vec![OpenedFile {
            path: "east.log".to_owned(),
            content: eastward().into(),
        }]);
        rig.settle();
    };
    let jobs: [(IsIt, Deed); 17] = [
        (|job| matches!(job, Job::Fly(_)), none),
        (|job| matches!(job, Job::FramePicture(_)), none),
        (|job| matches!(job, Job::DescribeMap(_)), none),
        (|job| matches!(job, Job::Tile(_)), none),
        (|job| matches!(job, Job::TakeHeights(_)), open_heights),
        (|job| matches!(job, Job::Open(_)), open_a_file),
        (|job| matches!(job, Job::Provide(_)), open_a_file),
        (|job| matches!(job, Job::Outage(_)), cut),
        (|job| matches!(job, Job::Pack(_)), save),
        (|job| matches!(job, Job::ExplainMatch(_)), explain),
        (|job| matches!(job, Job::Contest(_)), compare),
        (|job| matches!(job, Job::Smooth(_)), smooth),
        (|job| matches!(job, Job::Field(_)), heat),
        (|job| matches!(job, Job::Predict(_)), route),
        (|job| matches!(job, Job::Suggest(_)), suggest),
        (|job| matches!(job, Job::ReadLog(_)), log),
        (|job| matches!(job, Job::LogSeries(_)), log),
    ];
    let fault = vec!["\"An answer was not used\"".to_owned()];
    let told = jobs.map(|(is_it, ask)| faults_of_strange_answer(is_it, ask));
    assert_eq!(told.to_vec(), vec![Some(fault); told.len()]);
}

#[test]
fn what_a_worker_says_of_the_map_is_told_whoever_asked_for_it() {
    let mut rig = rig_on(
        ScriptedHost {
            left: Some(|job| matches!(job, Job::Suggest(_))),
            ..ScriptedHost::default()
        },
        egui::vec2(1440.0, 900.0),
    );
    rig.open_tab("Plan");
    rig.settle();
    rig.open_tab("Landmarks");
    let label = "Suggest 6 landmarks for the map";
    rig.harness.get_by_label(label).click();
    rig.frames(3);
    let host = rig.host();
    let job = host.jobs.iter().rev();
    let mut job = job.filter(|(_, job)| matches!(job, Job::Suggest(_)));
    let job = job.next().expect("asked for").0;
    let text = "the tiles of the map did not come".to_owned();
    host.events.push((job, JobEvent::Remark(text)));
    rig.frames(3);
    let state = rig.state();
    let toasts = state["toasts"].as_array().expect("a list").iter();
    let titles: Vec<_> = toasts.map(|toast| toast["title"].to_string()).collect();
    assert_eq!(titles, ["\"A part of the map stays empty\""]);
}

#[test]
fn an_answer_for_which_no_part_of_the_app_waits_is_told() {
    for owner in [
        JobOwner::Flight,
        JobOwner::FramePictures,
        JobOwner::Map,
        JobOwner::Heights,
        JobOwner::Openings,
        JobOwner::Files,
    ] {
        let mut rig = rig();
        let host = rig.host();
        host.owners.own(9_999, owner);
        host.events.push((9_999, JobEvent::Places(Vec::new())));
        rig.frames(3);
        assert_eq!(faults(&rig), ["\"An answer was not used\""], "{owner:?}");
    }
}
