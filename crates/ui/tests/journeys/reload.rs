use egui::{Key, Modifiers, Vec2};

use super::support::{ScriptedHost, rig, rig_on};

#[test]
fn a_landmark_survives_a_reload_and_an_undone_one_does_not() {
    let mut rig = rig();
    rig.key(Key::N);
    let middle = rig.rect("/map/rect").center();
    rig.drag(middle, middle + Vec2::new(60.0, 44.0));
    rig.key(Key::Enter);
    rig.key(Key::N);
    rig.drag(
        middle - Vec2::new(160.0, 120.0),
        middle - Vec2::new(90.0, 70.0),
    );
    rig.key(Key::Enter);
    rig.frames(2);
    assert_eq!(rig.state()["landmarks"].as_array().map(Vec::len), Some(6));
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(rig.state()["landmarks"].as_array().map(Vec::len), Some(5));
    rig.settle();
    let stored = rig.host().stored.clone();
    let again = rig_on(
        ScriptedHost {
            stored,
            ..ScriptedHost::default()
        },
        Vec2::new(1440.0, 900.0),
    );
    let state = again.state();
    assert_eq!(state["landmarks"].as_array().map(Vec::len), Some(5));
    assert_eq!(state["run_landmarks"], 5);
}

#[test]
fn the_view_is_as_it_was_left() {
    let mut rig = rig();
    rig.key(Key::U);
    rig.key(Key::Num7);
    rig.settle();
    let stored = rig.host().stored.clone();
    let again = rig_on(
        ScriptedHost {
            stored,
            ..ScriptedHost::default()
        },
        Vec2::new(1440.0, 900.0),
    );
    let state = again.state();
    assert_eq!(state["units"], "Aviation");
    assert_eq!(state["speed"], 8.0);
}
