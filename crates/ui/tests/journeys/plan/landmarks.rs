use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use serde_json::Value;

use super::super::support::Rig;
use super::{click, planning, screen};

fn landmarks(rig: &Rig) -> Vec<Value> {
    rig.state()["landmarks"]
        .as_array()
        .cloned()
        .expect("a list")
}

fn outline(rig: &mut Rig) {
    rig.key_with(Modifiers::SHIFT, Key::N);
    for (north, east) in [(-120.0, -120.0), (-120.0, 0.0), (-40.0, -60.0)] {
        click(rig, north, east);
    }
    rig.key(Key::Enter);
    rig.settle();
}

/// Clicks a row of the table of landmarks.
fn row(rig: &mut Rig, name: &str, keys: Modifiers) {
    let label = format!("{name}: ");
    let row = rig
        .harness
        .get_by(|n| n.label().is_some_and(|l| l.starts_with(&label)));
    let place = row.rect().center();
    rig.harness.event(egui::Event::PointerMoved(place));
    for pressed in [true, false] {
        rig.harness.event_modifiers(
            egui::Event::PointerButton {
                pos: place,
                button: egui::PointerButton::Primary,
                pressed,
                modifiers: keys,
            },
            keys,
        );
    }
    rig.frames(3);
}

#[test]
fn an_outline_is_drawn_by_clicks_and_its_corner_dragged_in_one_step() {
    let mut rig = planning();
    let before = landmarks(&rig).len();
    outline(&mut rig);
    let drawn = landmarks(&rig);
    assert_eq!(drawn.len(), before + 1);
    let corner = |rig: &Rig| landmarks(rig).last().expect("one")["outline"][2][0].as_f64();
    assert!((corner(&rig).expect("a corner") + 40.0).abs() < 2.0);
    // The field that names it is open.
    rig.key(Key::Enter);
    let (from, to) = (screen(&rig, -40.0, -60.0), screen(&rig, 10.0, -60.0));
    rig.drag(from, to);
    assert!((corner(&rig).expect("a corner") - 10.0).abs() < 3.0);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert!((corner(&rig).expect("a corner") + 40.0).abs() < 2.0);
}

#[test]
fn a_point_is_marked_by_one_click() {
    let mut rig = planning();
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.harness
        .event(egui::Event::Text("landmark as a point".into()));
    rig.frames(2);
    rig.key(Key::Enter);
    click(&mut rig, -140.0, 30.0);
    let list = landmarks(&rig);
    let last = list.last().expect("one");
    assert_eq!(last["point"], true);
    assert!((last["reference"][0].as_f64().expect("north") + 140.0).abs() < 2.0);
}

#[test]
fn several_landmarks_get_one_category_and_are_deleted_in_one_step_each() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    row(&mut rig, "Barn", Modifiers::NONE);
    row(&mut rig, "Pool", Modifiers::SHIFT);
    assert_eq!(
        rig.state()["plan"]["marked"].as_array().map(Vec::len),
        Some(3)
    );
    row(&mut rig, "Chapel", Modifiers::COMMAND);
    assert_eq!(
        rig.state()["plan"]["marked"].as_array().map(Vec::len),
        Some(2)
    );
    rig.harness.get_by_label("Category").focus();
    rig.frames(2);
    rig.harness.event(egui::Event::Text("old".into()));
    rig.frames(2);
    rig.key(Key::Enter);
    let categories: Vec<String> = landmarks(&rig)
        .iter()
        .map(|l| format!("{} {}", l["name"], l["category"]))
        .collect();
    assert_eq!(
        categories,
        [
            "\"Barn\" \"old\"",
            "\"Chapel\" \"\"",
            "\"Pool\" \"old\"",
            "\"Mill\" \"\""
        ]
    );
    rig.harness.get_by_label("Delete").click();
    rig.frames(3);
    assert_eq!(landmarks(&rig).len(), 2);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(landmarks(&rig).len(), 4);
    assert_eq!(landmarks(&rig)[0]["category"], "old");
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(landmarks(&rig)[0]["category"], "");
}

#[test]
fn the_table_shows_what_fits_the_filter() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Filter the landmarks").focus();
    rig.frames(2);
    rig.harness.event(egui::Event::Text("o".into()));
    rig.frames(3);
    let rows = rig
        .harness
        .query_all_by(|n| n.label().is_some_and(|l| l.ends_with(" metres")));
    assert_eq!(rows.count(), 1, "of the four only Pool has an o");
}

#[test]
fn notes_of_the_selected_landmark_are_kept() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    row(&mut rig, "Mill", Modifiers::NONE);
    rig.harness.get_by_label("Notes on the landmark").focus();
    rig.frames(2);
    rig.harness.event(egui::Event::Text("red roof".into()));
    rig.frames(2);
    rig.key(Key::Tab);
    rig.frames(2);
    assert_eq!(landmarks(&rig)[3]["notes"], "red roof");
}
