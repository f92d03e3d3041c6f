//! A flight log is dropped, looked over, and its fields are plotted.

use std::fmt::Write as _;

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_ui::host::OpenedFile;
use serde_json::Value;

use super::support::{Rig, rig};

/// A flight eastward at 20 m/s as a text log.
pub fn eastward() -> Vec<u8> {
    let mut log = String::from(
        "FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns\n\
         FMT, 1, 23, ATT, Qfff, TimeUS,Roll,Pitch,Yaw\n\
         FMT, 2, 27, GPS, QBLLfff, TimeUS,Status,Lat,Lng,Alt,Spd,GCrs\n",
    );
    for i in 0..300_u32 {
        let time = 1_000_000 + 100_000 * i;
        let along = 8.0 + f64::from(i) * 2.0 / 76_000.0;
        writeln!(log, "ATT, {time}, {}, {}, 90", i % 7, i % 5).expect("memory");
        let (height, speed) = (500 + i, 20.0 + 0.1 * f64::from(i % 3));
        writeln!(
            log,
            "GPS, {time}, 3, 47.0, {along:.7}, {height}, {speed}, 90"
        )
        .expect("memory");
    }
    log.into_bytes()
}

/// The app with that log read and its first fields plotted.
pub fn rig_with_a_log() -> Rig {
    rig_with("east.log", eastward())
}

fn rig_with(name: &str, content: Vec<u8>) -> Rig {
    let mut rig = rig();
    rig.host().really_open = true;
    rig.host().opened.push(vec![OpenedFile {
        path: name.to_owned(),
        content: content.into(),
    }]);
    rig.settle();
    rig
}

/// The fields of each panel.
pub fn panels(rig: &Rig) -> Vec<Vec<String>> {
    let state = rig.state();
    let panels = state["log"]["panels"].as_array().expect("panels").iter();
    let names = |panel: &Value| -> Vec<String> {
        let fields = panel.as_array().expect("fields").iter();
        fields
            .map(|f| f.as_str().unwrap_or_default().to_owned())
            .collect()
    };
    panels.map(names).collect()
}

#[test]
fn a_dropped_log_shows_its_overview_and_its_first_fields() {
    let rig = rig_with_a_log();
    let state = rig.state();
    assert_eq!(state["log"]["file"], "east.log");
    assert_eq!(state["log"]["read"], true);
    assert_eq!(state["side_tab"], "log");
    assert_eq!(
        panels(&rig),
        [
            vec!["GPS height"],
            vec!["Ground speed"],
            vec!["Roll", "Pitch"]
        ]
    );
    assert!(
        state["log"]["points"].as_u64() >= Some(300),
        "{}",
        state["log"]
    );
    rig.harness
        .get_by_label_contains("Greatest height above start 299");
    rig.harness.get_by_label_contains("Replay without GPS");
}

/// The same log without the lines of a message.
fn without(message: &str) -> Vec<u8> {
    let log = String::from_utf8(eastward()).expect("text");
    let lines = log.lines().filter(|line| !line.starts_with(message));
    let lines: Vec<&str> = lines.collect();
    (lines.join("\n") + "\n").into_bytes()
}

#[test]
fn a_log_without_heading_shows_its_track_on_no_map_of_another_flight() {
    let rig = rig_with("compassless.log", without("ATT, "));
    let state = rig.state();
    let why = state["log"]["unnavigable"].as_str().unwrap_or_default();
    assert!(why.contains("heading"), "{}", state["log"]);
    assert_eq!(state["flight"], "compassless.log");
    assert_eq!(state["landmarks"], Value::Array(Vec::new()));
    let origin = state["origin"][0].as_f64().expect("a latitude");
    assert!((origin - 47.0).abs() < 1e-6, "{origin}");
    assert!(rig.harness.query_by_label("greenhouse rows").is_none());
    rig.harness.get_by_label_contains("Replay without GPS");
    rig.harness.get_by_label("The flight cannot be navigated");
}

#[test]
fn a_log_without_fixes_is_plotted_beside_nothing_of_the_demo() {
    let rig = rig_with("indoors.log", without("GPS, "));
    let state = rig.state();
    let why = state["log"]["unnavigable"].as_str().unwrap_or_default();
    assert!(
        why.contains("starting point is unknown"),
        "{}",
        state["log"]
    );
    assert_eq!(panels(&rig), [["Roll", "Pitch"]]);
    assert!(state["flight"].is_null(), "{}", state["flight"]);
    assert_eq!(state["landmarks"], Value::Array(Vec::new()));
    assert!(
        rig.harness.query_by_label("Map").is_none(),
        "its plots have the room of a map on which nothing would lie"
    );
}

#[test]
fn plots_of_a_log_leave_the_map_its_place_however_long_they_are_shown() {
    let mut rig = rig_with_a_log();
    let before = rig.rect("/map/rect").height();
    rig.frames(120);
    assert_eq!(rig.rect("/map/rect").height(), before);
    let all = rig.harness.ctx.content_rect().height();
    assert!(before > 0.3 * all, "the map has {before} of {all} points");
}

#[test]
fn another_flight_takes_the_place_of_the_log() {
    let mut rig = rig_with_a_log();
    rig.menu("Open", "Simulate a flight…");
    rig.frames(8);
    rig.harness.get_by_label("Fly").click();
    rig.settle();
    assert!(rig.state()["log"].is_null(), "{}", rig.state()["log"]);
}

#[test]
fn a_field_is_searched_plotted_alone_taken_away_and_colours_the_track() {
    let mut rig = rig_with_a_log();
    rig.harness.get_by_label("Fields of the log").click();
    rig.frames(3);
    rig.harness.get_by_label("Search fields of the log").focus();
    rig.frames(2);
    rig.harness
        .get_by_label("Search fields of the log")
        .type_text("att.y");
    rig.frames(3);
    rig.harness.get_by_label("ATT.Yaw in a new plot").click();
    rig.settle();
    assert_eq!(panels(&rig)[3], ["ATT.Yaw"]);
    rig.harness.get_by_label("Plot ATT.Yaw").click();
    rig.frames(3);
    assert_eq!(panels(&rig).len(), 3);
    rig.harness
        .get_by_label("Colour the track by ATT.Yaw")
        .click();
    rig.settle();
    assert_eq!(rig.state()["log"]["track_by"], "ATT.Yaw");
    rig.harness.get_by_label("Take Pitch away").click();
    rig.frames(3);
    assert_eq!(panels(&rig)[2], ["Roll"]);
}

/// The field for expressions, with the keyboard.
fn at_expressions(rig: &mut Rig) {
    rig.harness.get_by_label("Fields of the log").click();
    rig.frames(3);
    rig.harness.get_by_label("Expression over fields").focus();
    rig.frames(2);
}

fn type_expression(rig: &mut Rig, text: &str) {
    rig.harness
        .get_by_label("Expression over fields")
        .type_text(text);
    rig.frames(3);
}

fn written(rig: &Rig) -> String {
    let field = rig.harness.get_by_label("Expression over fields");
    field.value().unwrap_or_default()
}

#[test]
fn a_name_in_an_expression_is_completed_by_keys_and_the_expression_is_plotted() {
    let mut rig = rig_with_a_log();
    at_expressions(&mut rig);
    type_expression(&mut rig, "2 * att.r");
    rig.harness.get_by_label("Write ATT.Roll");
    rig.key(Key::Tab);
    assert_eq!(written(&rig), "2 * ATT.Roll");
    type_expression(&mut rig, " - pitc");
    rig.key(Key::ArrowDown);
    rig.key(Key::Enter);
    assert_eq!(written(&rig), "2 * ATT.Roll - ATT.Pitch");
    let before = panels(&rig).len();
    rig.key(Key::Enter);
    rig.settle();
    let after = panels(&rig);
    assert_eq!(after.len(), before + 1);
    assert_eq!(after[before], ["2 * ATT.Roll - ATT.Pitch"]);
    assert_eq!(written(&rig), "");
    rig.harness.get_by_label("Plot of 2 * ATT.Roll - ATT.Pitch");
    rig.harness.get_by_label("Forget 2 * ATT.Roll - ATT.Pitch");
}

#[test]
fn a_proposed_name_is_taken_by_a_click_and_refused_by_escape() {
    let mut rig = rig_with_a_log();
    at_expressions(&mut rig);
    type_expression(&mut rig, "abs(groun");
    rig.harness.get_by_label("Write {Ground speed}").click();
    rig.frames(4);
    assert_eq!(written(&rig), "abs({Ground speed}");
    type_expression(&mut rig, " + at");
    rig.key(Key::Escape);
    assert!(rig.harness.query_by_label("Write ATT.Roll").is_none());
    assert_eq!(written(&rig), "abs({Ground speed} + at");
}

#[test]
fn what_is_wrong_with_an_expression_is_said_with_its_place() {
    let mut rig = rig_with_a_log();
    at_expressions(&mut rig);
    type_expression(&mut rig, "ATT.Rol + 1");
    rig.harness
        .get_by_label("Letter 1: no series is called ATT.Rol; did you mean ATT.Roll?");
    let before = panels(&rig).len();
    rig.key(Key::Enter);
    rig.frames(3);
    assert_eq!(panels(&rig).len(), before);
    assert_eq!(written(&rig), "ATT.Rol + 1");
}

#[test]
fn an_expression_is_plotted_beside_other_fields_with_shift() {
    let mut rig = rig_with_a_log();
    at_expressions(&mut rig);
    type_expression(&mut rig, "smooth(ATT.Roll, 1)");
    rig.key_with(Modifiers::SHIFT, Key::Enter);
    rig.settle();
    let panels = panels(&rig);
    assert_eq!(panels.len(), 3);
    assert!(
        panels
            .iter()
            .any(|p| p.last().is_some_and(|f| f == "smooth(ATT.Roll, 1)"))
    );
}
