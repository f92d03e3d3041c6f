use egui::{Key, Pos2};

use super::support::rig;

#[test]
fn a_drag_on_the_timeline_moves_the_time_cursor() {
    let mut rig = rig();
    let track = rig.rect("/timeline");
    let at = |part: f32| Pos2::new(track.left() + part * track.width(), track.center().y);
    rig.drag(at(0.1), at(0.5));
    let state = rig.state();
    let time = state["time"].as_f64().expect("a time");
    let span = state["span"][1].as_f64().expect("a span");
    assert!((time / span - 0.5).abs() < 0.02, "{time} of {span}");
    let step = state["step"]["time"].as_f64().expect("a step");
    assert!((step - time).abs() < 0.2, "the views follow");
}

#[test]
fn arrows_step_by_camera_frames() {
    let mut rig = rig();
    rig.key(Key::Home);
    rig.key(Key::ArrowRight);
    rig.key(Key::ArrowRight);
    assert_eq!(rig.state()["time"].as_f64(), Some(1.0));
    rig.key(Key::ArrowLeft);
    assert_eq!(rig.state()["time"].as_f64(), Some(0.5));
    rig.key(Key::End);
    assert_eq!(rig.state()["time"], rig.state()["span"][1]);
}

#[test]
fn digits_set_the_speed() {
    let mut rig = rig();
    rig.key(Key::Num1);
    assert_eq!(rig.state()["speed"], 0.1);
    rig.key(Key::Num0);
    assert_eq!(rig.state()["speed"], 20.0);
}
