use egui::Key;
use egui_kittest::kittest::Queryable as _;

use super::support::rig;

#[test]
fn arrows_move_a_landmark_and_shift_resizes_it() {
    let mut rig = rig();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Barn").focus();
    rig.frames(2);
    let time = rig.state()["time"].clone();
    let before = rig.state()["landmarks"][0].clone();
    rig.key(Key::ArrowUp);
    let moved = rig.state()["landmarks"][0].clone();
    let metres = |v: &serde_json::Value, k: &str| v[k].as_f64().expect("metres");
    assert!((metres(&moved, "north") - metres(&before, "north") - 1.0).abs() < 1e-9);
    assert!((metres(&moved, "south") - metres(&before, "south") - 1.0).abs() < 1e-9);
    rig.key_with(egui::Modifiers::SHIFT, Key::ArrowRight);
    let resized = rig.state()["landmarks"][0].clone();
    assert!((metres(&resized, "east") - metres(&moved, "east") - 1.0).abs() < 1e-9);
    assert_eq!(metres(&resized, "west"), metres(&moved, "west"));
    assert_eq!(
        rig.state()["time"],
        time,
        "the arrows do not also move time"
    );
}
