use egui::{Key, Vec2};

use super::support::{Rig, rig};

#[test]
fn a_box_drawn_on_the_map_becomes_a_landmark_and_the_flight_is_flown_again() {
    let mut rig = rig();
    let before = rig.host().flights();
    rig.key(Key::N);
    let middle = rig.rect("/map/rect").center();
    rig.drag(middle, middle + Vec2::new(60.0, 44.0));
    let state = rig.state();
    assert_eq!(state["landmarks"].as_array().map(Vec::len), Some(5));
    assert_eq!(state["selection"], 5);
    rig.settle();
    assert_eq!(rig.host().flights(), before + 1);
    let state = rig.state();
    assert_eq!(state["run_landmarks"], 5);
    assert!(
        state["ghost_steps"].as_u64() > Some(0),
        "the old run stays as a ghost"
    );
    assert!(
        state["distinctness"].is_string(),
        "its distinctness is known"
    );
}

/// A landmark that was drawn, in whose field "Silo" is typed.
fn being_named() -> Rig {
    let mut rig = rig();
    rig.key(Key::N);
    let middle = rig.rect("/map/rect").center();
    rig.drag(middle, middle + Vec2::new(60.0, 44.0));
    rig.frames(3);
    rig.key_with(egui::Modifiers::COMMAND, Key::A);
    rig.harness.event(egui::Event::Text("Silo".into()));
    rig.frames(2);
    rig
}

#[test]
fn a_landmark_is_named_in_place() {
    let mut rig = being_named();
    rig.key(Key::Enter);
    assert_eq!(rig.state()["landmarks"][4]["name"], "Silo");
}

#[test]
fn a_typed_name_is_kept_by_a_click_on_the_map_and_forgotten_by_escape() {
    let mut rig = being_named();
    let map = rig.rect("/map/rect");
    let at = map.center() - 0.3 * map.size();
    rig.harness.drag_at(at);
    rig.frames(1);
    rig.harness.drop_at(at);
    rig.frames(3);
    assert_eq!(rig.state()["landmarks"][4]["name"], "Silo");
    let mut rig = being_named();
    rig.key(Key::Escape);
    assert_eq!(rig.state()["landmarks"][4]["name"], "Landmark 5");
}
