use egui::{Key, Modifiers};

use super::{draw, planning};

#[test]
fn the_brief_of_a_route_is_printed_with_its_legs_landmarks_and_prediction() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (60.0, 0.0), (0.0, 300.0)]);
    rig.key_with(Modifiers::COMMAND, Key::P);
    rig.settle();
    let (style, body) = rig.host().printed.take().expect("a page");
    assert!(style.contains("@page"), "{style}");
    for words in [
        "Route 1",
        "Predicted error",
        "largest error (1σ)",
        "Legs",
        "Landmarks",
        "Wind from",
    ] {
        assert!(body.contains(words), "{words}");
    }
}

#[test]
fn without_a_route_there_is_nothing_to_print() {
    let mut rig = planning();
    rig.key_with(Modifiers::COMMAND, Key::P);
    rig.settle();
    assert!(rig.host().printed.is_none());
}
