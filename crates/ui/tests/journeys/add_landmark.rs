use egui::{Key, Vec2};

use super::support::rig;

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

#[test]
fn a_landmark_is_named_in_place() {
    let mut rig = rig();
    rig.key(Key::N);
    let middle = rig.rect("/map/rect").center();
    rig.drag(middle, middle + Vec2::new(60.0, 44.0));
    rig.frames(3);
    rig.key_with(egui::Modifiers::COMMAND, Key::A);
    rig.harness.event(egui::Event::Text("Silo".into()));
    rig.frames(2);
    rig.key(Key::Enter);
    assert_eq!(rig.state()["landmarks"][4]["name"], "Silo");
}
