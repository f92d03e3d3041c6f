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

#[test]
fn delete_on_a_row_deletes_its_landmark_and_not_the_selected_one_too() {
    let mut rig = rig();
    rig.open_tab("Landmarks");
    let names = |rig: &super::support::Rig| {
        let landmarks = rig.state()["landmarks"].as_array().cloned();
        let landmarks = landmarks.unwrap_or_default().into_iter();
        landmarks.map(|it| it["name"].clone()).collect::<Vec<_>>()
    };
    let before = names(&rig);
    rig.harness.get_by_label("Barn").click();
    rig.frames(3);
    rig.harness.get_by_label("Chapel").focus();
    rig.frames(2);
    rig.key(Key::Delete);
    rig.frames(2);
    let left: Vec<_> = before.into_iter().filter(|it| it != "Chapel").collect();
    assert_eq!(names(&rig), left);
}
