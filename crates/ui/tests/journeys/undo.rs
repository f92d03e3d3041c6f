use egui::{Key, Modifiers, Pos2, Vec2};

use super::support::{Rig, rig};

/// Selects the first landmark; its middle on the screen.
fn select_barn(rig: &mut Rig) -> Pos2 {
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
    at
}

#[test]
fn a_dragged_landmark_goes_back_in_one_step_and_forth_again() {
    let mut rig = rig();
    let at = select_barn(&mut rig);
    let barn = rig.state()["landmarks"][0].clone();
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

#[test]
fn escape_takes_a_landmark_back_to_where_it_was_taken() {
    let mut rig = rig();
    let at = select_barn(&mut rig);
    rig.settle();
    let (before, flights) = (rig.state(), rig.host().flights());
    rig.harness.drag_at(at);
    rig.frames(1);
    for part in 1..=3 {
        rig.harness
            .hover_at(at + Vec2::new(10.0 * part as f32, 0.0));
        rig.frames(1);
    }
    assert_ne!(rig.state()["landmarks"][0], before["landmarks"][0]);
    rig.key(Key::Escape);
    rig.harness.hover_at(at + Vec2::new(50.0, 0.0));
    rig.frames(1);
    rig.harness.drop_at(at + Vec2::new(50.0, 0.0));
    rig.settle();
    let after = rig.state();
    for key in ["landmarks", "undo", "selection"] {
        assert_eq!(after[key], before[key], "{key}");
    }
    assert_eq!(
        rig.host().flights(),
        flights,
        "there is nothing to fly anew"
    );
}
