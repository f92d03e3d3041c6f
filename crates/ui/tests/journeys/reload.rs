use egui::{Key, Modifiers, Vec2};

use super::support::{Rig, ScriptedHost, rig, rig_on};

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

#[test]
fn what_is_edited_while_the_flight_of_the_last_visit_starts_stays() {
    let mut rig = rig();
    rig.key(Key::N);
    let middle = rig.rect("/map/rect").center();
    rig.drag(middle, middle + Vec2::new(60.0, 44.0));
    rig.key(Key::Enter);
    rig.settle();
    let stored = rig.host().stored.clone();
    let host = ScriptedHost {
        stored,
        silent_flights: true,
        ..ScriptedHost::default()
    };
    let mut again = rig_on(host, Vec2::new(1440.0, 900.0));
    assert_eq!(again.state()["run_steps"], 0);
    let landmarks = |rig: &Rig| rig.state()["landmarks"].as_array().map(Vec::len);
    assert_eq!(landmarks(&again), Some(5));
    again.key(Key::N);
    again.drag(
        middle - Vec2::new(160.0, 120.0),
        middle - Vec2::new(90.0, 70.0),
    );
    again.key(Key::Enter);
    assert_eq!(landmarks(&again), Some(6));
    // The flight begins with the five that it was given.
    again.host().begin_flights();
    again.frames(3);
    assert_eq!(landmarks(&again), Some(6));
    again.settle();
    assert_eq!(again.state()["run_landmarks"], 6);
    again.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(landmarks(&again), Some(5));
}

#[test]
fn what_is_edited_before_the_first_flight_tells_its_mission_is_added_to_it() {
    let host = ScriptedHost {
        silent_flights: true,
        ..ScriptedHost::default()
    };
    let mut rig = rig_on(host, Vec2::new(1440.0, 900.0));
    let landmarks = |rig: &Rig| rig.state()["landmarks"].as_array().map(Vec::len);
    assert_eq!(landmarks(&rig), Some(0));
    let middle = rig.rect("/map/rect").center();
    rig.key(Key::N);
    rig.drag(middle, middle + Vec2::new(60.0, 44.0));
    rig.key(Key::Enter);
    rig.frames(60);
    assert_eq!(landmarks(&rig), Some(1));
    rig.host().begin_flights();
    rig.frames(3);
    assert_eq!(landmarks(&rig), Some(5));
    rig.settle();
    assert_eq!(rig.state()["run_landmarks"], 5);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(landmarks(&rig), Some(4));
}
