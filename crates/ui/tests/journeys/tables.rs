//! Tables of a flight are looked over, and whatever stands in them is plotted, as that of a log is.

use egui::{Key, Modifiers, Vec2};
use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::{Job, JobEvent};

use super::column_map::asked;
use super::log::panels;
use super::support::{Rig, ScriptedHost, rig_on};

/// The app with the flight of two tables open, of whose column `quux` nothing was said.
fn opened() -> Rig {
    let mut rig = asked();
    rig.harness.get_by_label("Open flight").click();
    rig.settle();
    rig
}

fn search(rig: &mut Rig, words: &str) {
    rig.harness.get_by_label("Fields of the log").click();
    rig.frames(3);
    rig.harness.get_by_label("Search fields of the log").focus();
    rig.frames(2);
    let field = rig.harness.get_by_label("Search fields of the log");
    field.type_text(words);
    rig.frames(3);
}

#[test]
fn the_flight_of_tables_opens_with_its_overview_and_its_first_fields() {
    let rig = opened();
    let state = rig.state();
    let log = &state["log"];
    assert_eq!(log["file"], "x", "{}", state["toasts"]);
    assert_eq!(
        (&log["read"], &log["format"]),
        (&true.into(), &"Tables".into())
    );
    assert_eq!(log["topics"], 2);
    assert_eq!(log["messages"], 600);
    assert_eq!(state["side_tab"], "log");
    assert_eq!(panels(&rig), [vec!["GPS height"], vec!["Roll", "Pitch"]]);
    assert!(log["points"].as_u64() >= Some(600), "{log}");
    assert_eq!(state["run_complete"], true);
    // What measured, and how often; what can be done, and what not and why.
    rig.harness.get_by_label("att.roll_deg");
    rig.harness.get_by_label("gps.lat");
    rig.harness
        .get_by_label_contains("There is no airspeed in it");
    // What was assumed is said by the notice, and stays in the overview.
    let assumed = "the GPS height above the start stands for it";
    assert_eq!(rig.harness.query_all_by_label_contains(assumed).count(), 2);
}

#[test]
fn a_column_that_nothing_was_said_of_is_found_plotted_and_colours_the_track() {
    let mut rig = opened();
    search(&mut rig, "quux");
    rig.harness.get_by_label("gps.quux in a new plot").click();
    rig.settle();
    assert_eq!(panels(&rig)[2], ["gps.quux"]);
    rig.harness
        .get_by_label("Colour the track by gps.quux")
        .click();
    rig.settle();
    let log = rig.state()["log"].clone();
    assert_eq!(log["track_by"], "gps.quux");
    assert_eq!(log["points"], 1200);
}

#[test]
fn columns_are_computed_with() {
    let mut rig = opened();
    rig.harness.get_by_label("Fields of the log").click();
    rig.frames(3);
    rig.harness.get_by_label("Expression over fields").focus();
    rig.frames(2);
    let field = rig.harness.get_by_label("Expression over fields");
    field.type_text("gps.quux - {GPS height}");
    rig.key(Key::Enter);
    rig.settle();
    assert_eq!(panels(&rig)[2], ["gps.quux - {GPS height}"]);
    rig.harness.get_by_label("Plot of gps.quux - {GPS height}");
}

#[test]
fn after_a_reload_the_tables_are_read_again() {
    let mut rig = opened();
    let stored = rig.host().stored.clone();
    let host = ScriptedHost {
        stored,
        ..ScriptedHost::default()
    };
    let mut again = rig_on(host, Vec2::new(1440.0, 900.0));
    again.settle();
    let state = again.state();
    assert_eq!(state["log"]["file"], "x", "{}", state["toasts"]);
    assert_eq!(state["log"]["topics"], 2);
    assert_eq!(state["flight"], "x");
    again.harness.get_by_label("gps.lat");
}

fn export_track(rig: &mut Rig) {
    rig.key_with(Modifiers::COMMAND, Key::K);
    let words = "save the flown track as csv";
    rig.harness.event(egui::Event::Text(words.into()));
    rig.frames(2);
    rig.key(Key::Enter);
    rig.settle();
}

#[test]
fn a_coloured_track_is_exported_after_the_worker_that_had_the_log_was_lost() {
    let mut rig = opened();
    search(&mut rig, "quux");
    rig.harness
        .get_by_label("Colour the track by gps.quux")
        .click();
    rig.settle();
    let readings = |rig: &mut Rig| {
        let jobs = rig.host().jobs.iter();
        jobs.filter(|(_, job)| matches!(job, Job::ReadLog(_)))
            .count()
    };
    let before = readings(&mut rig);
    rig.host().left = Some(|job| matches!(job, Job::Export(_)));
    export_track(&mut rig);
    let asked = rig.host().jobs.last().cloned();
    let Some((asked, Job::Export(_))) = asked else {
        panic!("{asked:?}");
    };
    let why = "x: it is not read yet".to_owned();
    rig.host().events.push((asked, JobEvent::Failed(why)));
    rig.settle();
    rig.harness
        .get_by_label_contains("export once more after that");
    assert_eq!(readings(&mut rig), before + 1);
    rig.host().left = None;
    export_track(&mut rig);
    let (name, bytes) = rig.host().saved.pop().expect("a file");
    assert!(name.ends_with("-track.csv"), "{name}");
    let text = String::from_utf8(bytes).expect("a table");
    assert!(text.starts_with("time") && text.contains("quux"), "{text}");
}
