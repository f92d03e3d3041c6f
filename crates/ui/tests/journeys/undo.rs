use egui::{Key, Modifiers, Vec2};

use super::support::rig;

#[test]
fn a_dragged_landmark_goes_back_in_one_step_and_forth_again() {
    let mut rig = rig();
    rig.key(Key::F);
    rig.frames(2);
    let state = rig.state();
    let barn = &state["landmarks"][0];
    let metres = |k: &str| barn[k].as_f64().expect("metres");
    let center = [
        0.5 * (metres("north") + metres("south")),
        0.5 * (metres("east") + metres("west")),
    ];
    let map = rig.rect("/map/rect");
    let scale = state["map"]["metres_per_point"].as_f64().expect("a scale");
    let middle = |i: usize| state["map"]["center"][i].as_f64().expect("a centre");
    let offset = Vec2::new(
        ((center[1] - middle(1)) / scale) as f32,
        (-(center[0] - middle(0)) / scale) as f32,
    );
    let at = map.center() + offset;
    rig.harness.hover_at(at);
    rig.frames(1);
    rig.harness.drag_at(at);
    rig.frames(1);
    rig.harness.drop_at(at);
    rig.frames(3);
    assert_eq!(rig.state()["selection"], 1);
    let undo_depth = rig.state()["undo"].as_u64();
    rig.drag(at, at + Vec2::new(30.0, 0.0));
    let moved = rig.state();
    assert!(moved["landmarks"][0]["west"].as_f64() > barn["west"].as_f64());
    assert_eq!(moved["undo"].as_u64(), undo_depth.map(|d| d + 1));
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(rig.state()["landmarks"][0]["west"], barn["west"]);
    rig.key_with(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    assert_eq!(
        rig.state()["landmarks"][0]["west"],
        moved["landmarks"][0]["west"]
    );
}
