//! A camera is put in time and place beside its log.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_core::calibration::CameraAdjustment;
use pilotage_jobs::{FlyOrder, Job, OpenedFiles};
use pilotage_ui::host::OpenedFile;
use serde_json::Value;

use super::open_map::a_map;
use super::reopen::nothing;
use super::support::flight::{mission, run};
use super::support::laid::{Laying, early_flight};
use super::support::{Rig, ScriptedHost, rig, rig_on};

/// The invented flight with fixes, its pictures stamped half a second early, all of them laid on the map.
fn rig_with_laid_frames() -> Rig {
    let host = ScriptedHost {
        laying: Laying::Always,
        ..ScriptedHost::default()
    };
    rig_on(host, egui::vec2(1440.0, 900.0))
}

fn open(rig: &mut Rig) {
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.harness.event(egui::Event::Text("camera to log".into()));
    rig.frames(2);
    rig.key(Key::Enter);
    rig.frames(3);
}

fn number(rig: &Rig, pointer: &str) -> f64 {
    let state = rig.state();
    let value = state.pointer(pointer).and_then(Value::as_f64);
    value.unwrap_or_else(|| panic!("{pointer}: {}", state["camera_log"]))
}

fn estimated() -> Rig {
    let mut rig = rig_with_laid_frames();
    open(&mut rig);
    rig.harness.get_by_label("Estimate").click();
    rig.settle();
    rig
}

/// Camera adjustment that the last flight was asked to fly with.
fn flown_with(rig: &mut Rig) -> Option<CameraAdjustment> {
    let flown = rig.host().last_flight().cloned();
    let Some((_, Job::Fly(FlyOrder { mission, .. }))) = flown else {
        panic!("nothing was flown");
    };
    mission.and_then(|mission| mission.camera_to_log)
}

#[test]
fn the_palette_opens_it_and_it_says_what_is_missing() {
    let mut rig = rig();
    open(&mut rig);
    assert_eq!(rig.state()["side_tab"], "camera_log");
    rig.harness.get_by_label_contains("no satellite navigation");
    assert!(rig.harness.query_by_label("Estimate").is_none());
    rig.harness.get_by_label("Close").click();
    rig.frames(3);
    assert_ne!(rig.state()["side_tab"], "camera_log");
}

#[test]
fn the_estimate_is_told_with_units_and_deviations() {
    let rig = estimated();
    let told = rig.state()["camera_log"]["estimate"]["told"].clone();
    let (offset, deviation) = (&told["offset"]["value"], &told["offset"]["deviation"]);
    let error = (offset.as_f64().expect("a number") - 0.5).abs();
    assert!(error < 3.0 * deviation.as_f64().expect("one"), "{told}");
    assert!(error < 0.1, "{told}");
    for name in [
        "Time offset, s",
        "Clock drift, µs/s",
        "Mount yaw, °",
        "Focal length, %",
        "GPS bias north, m",
    ] {
        rig.harness.get_by_label(name);
    }
    rig.harness
        .get_by_label_contains("frames. GPS scatters about them");
    let before = number(&rig, "/camera_log/position_rms/0");
    let after = number(&rig, "/camera_log/position_rms/1");
    assert!(before > 5.0 * after, "{before} {after}");
}

#[test]
fn the_residuals_follow_the_hand() {
    let mut rig = estimated();
    let before = number(&rig, "/camera_log/position_rms/2");
    let slider = rig
        .harness
        .get_by_role_and_label(egui::accesskit::Role::Slider, "Time offset")
        .rect();
    let at = |share: f32| egui::pos2(slider.left() + share * slider.width(), slider.center().y);
    rig.drag(at(0.58), at(0.75));
    let offset = number(&rig, "/camera_log/by_hand/offset_s");
    assert!((1.0..2.0).contains(&offset), "{offset}");
    let after = number(&rig, "/camera_log/position_rms/2");
    assert!(after > 5.0 * before, "{before} {after}");
    assert_eq!(
        flown_with(&mut rig),
        None,
        "nothing is flown until it is applied"
    );
    rig.harness.get_by_label("Use the estimate").click();
    rig.frames(3);
    assert!((number(&rig, "/camera_log/position_rms/2") - before).abs() < 1e-9);
}

#[test]
fn what_is_applied_moves_the_pictures_in_time_and_can_be_taken_back() {
    let mut rig = estimated();
    let before = number(&rig, "/camera_log/frame_times/0");
    let flights = rig.host().flights();
    rig.harness.get_by_label("Apply").click();
    rig.settle();
    assert_eq!(rig.host().flights(), flights + 1);
    let change = flown_with(&mut rig).expect("a change");
    let moved = number(&rig, "/camera_log/frame_times/0") - before;
    assert!((moved - 0.5).abs() < 0.1, "{moved}");
    assert!((moved - (change.time(before) - before)).abs() < 1e-9);
    // As the flight was opened, the pictures are as far from the log as they were.
    assert!(number(&rig, "/camera_log/position_rms/0") > 4.0);
    assert!(number(&rig, "/camera_log/position_rms/2") < 1.0);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    rig.settle();
    assert_eq!(flown_with(&mut rig), None);
    assert!((number(&rig, "/camera_log/frame_times/0") - before).abs() < 1e-9);
}

/// Finding of the overview about the camera's clock.
fn said_of_the_clock(rig: &mut Rig) -> String {
    let findings = rig.state()["log"]["findings"].clone();
    let findings = findings.as_array().cloned().unwrap_or_default();
    let titles = findings.iter().filter_map(Value::as_str);
    let of_clock = |title: &&str| title.contains("stamped") || title.contains("lag between");
    let said: Vec<&str> = titles.filter(of_clock).collect();
    assert_eq!(said.len(), 1, "{findings:?}");
    let close = rig.harness.query_by_label("Close").map(|n| n.click());
    rig.frames(3 * usize::from(close.is_some()));
    rig.open_tab("Log");
    rig.harness.get_by_label(said[0]);
    said[0].to_owned()
}

#[test]
fn the_overview_tells_the_lag_that_is_left() {
    let mut rig = rig_with_laid_frames();
    rig.host().opens = Some(OpenedFiles {
        flight: Some(early_flight()),
        ..nothing()
    });
    rig.host().opened.push(vec![OpenedFile {
        path: "trip/flight.json".to_owned(),
        content: vec![7; 100].into(),
    }]);
    rig.settle();
    // Nobody asked for it.
    let said = said_of_the_clock(&mut rig);
    assert!(said.starts_with("Pictures are stamped 0.5"), "{said}");
    open(&mut rig);
    rig.harness.get_by_label("Apply").click();
    rig.settle();
    let left = said_of_the_clock(&mut rig);
    assert_eq!(left, "No lag between pictures and log");
    rig.key_with(Modifiers::COMMAND, Key::Z);
    rig.settle();
    assert_eq!(said_of_the_clock(&mut rig), said);
}

#[test]
fn reset_restores_the_flight_as_it_was_opened() {
    let mut rig = estimated();
    let before = number(&rig, "/camera_log/frame_times/0");
    rig.harness.get_by_label("Apply").click();
    rig.settle();
    rig.harness.get_by_label("Reset").click();
    rig.settle();
    assert_eq!(flown_with(&mut rig), None);
    assert!((number(&rig, "/camera_log/frame_times/0") - before).abs() < 1e-9);
    assert!(number(&rig, "/camera_log/by_hand/offset_s").abs() < 1e-12);
}

#[test]
fn a_run_without_whole_frames_is_flown_with_them_and_then_estimated() {
    let mut rig = rig_with_laid_frames();
    rig.host().laying = Laying::IfAsked;
    rig.key(Key::R);
    rig.settle();
    open(&mut rig);
    assert_eq!(rig.state()["camera_log"]["missing"], "FrameRegistration");
    rig.harness
        .get_by_label("Lay whole pictures and estimate")
        .click();
    rig.settle();
    assert!(rig.state()["camera_log"]["estimate"].is_object());
    rig.harness.get_by_label("Time offset, s");
}

#[test]
fn the_estimate_of_another_map_is_left_and_that_of_now_is_made() {
    let estimates = |rig: &mut Rig| {
        let jobs = &rig.host().jobs;
        jobs.iter()
            .filter(|(_, job)| matches!(job, Job::Calibrate(_)))
            .count()
    };
    let mut rig = estimated();
    let before = estimates(&mut rig);
    assert!(rig.state()["camera_log"]["estimate"].is_object());
    rig.host().opens = Some(a_map(None));
    rig.host().opened.push(vec![OpenedFile {
        path: "county.tif".to_owned(),
        content: vec![1, 2, 3].into(),
    }]);
    rig.settle();
    // The run is still the one over the map of before.
    assert!(rig.state()["camera_log"]["estimate"].is_object());
    rig.host().left = Some(|job| matches!(job, Job::Calibrate(_)));
    rig.key(Key::R);
    rig.settle();
    assert!(rig.state()["camera_log"]["estimate"].is_null());
    assert_eq!(estimates(&mut rig), before + 1);
    let (before, after) = ("/camera_log/position_rms/0", "/camera_log/position_rms/2");
    assert_eq!(
        number(&rig, before),
        number(&rig, after),
        "the hand is free"
    );
}

#[test]
fn no_estimate_comes_after_a_run_that_was_opened_over_another_map() {
    let estimates = |rig: &mut Rig| {
        let jobs = rig.host().jobs.iter();
        jobs.filter(|(_, job)| matches!(job, Job::Calibrate(_)))
            .count()
    };
    let mut rig = estimated();
    rig.harness.get_by_label("Apply").click();
    rig.settle();
    let run = OpenedFiles {
        run: Some(run(&mission())),
        ..nothing()
    };
    for (path, opens) in [("county.tif", a_map(None)), ("invented.run", run)] {
        rig.host().opens = Some(opens);
        rig.host().opened.push(vec![OpenedFile {
            path: path.to_owned(),
            content: vec![1, 2, 3].into(),
        }]);
        rig.settle();
    }
    assert!(rig.state()["camera_log"]["estimate"].is_null());
    let before = estimates(&mut rig);
    rig.key(Key::R);
    rig.settle();
    assert_eq!(estimates(&mut rig), before, "the adjustment is applied");
}

#[test]
fn its_shortcut_is_its_own() {
    let mut rig = rig();
    rig.key_with(Modifiers::SHIFT, Key::T);
    rig.frames(2);
    assert_eq!(rig.state()["side_tab"], "camera_log");
}

#[test]
fn the_sheet_keeps_its_width() {
    let mut rig = estimated();
    let left = |rig: &Rig| rig.harness.get_by_label("Estimate").rect().left();
    let before = left(&rig);
    rig.frames(30);
    assert_eq!(left(&rig), before);
}
