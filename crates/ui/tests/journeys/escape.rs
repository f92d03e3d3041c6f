//! Escape: a press takes one thing away, the topmost.

use egui::Key;
use egui_kittest::kittest::Queryable as _;

use super::plan::{click, planning};
use super::support::Rig;

fn is_drawing(rig: &Rig) -> bool {
    rig.state()["plan"]["drawing"] == true
}

/// A route of two way-points that is being drawn.
fn drawing() -> Rig {
    let mut rig = planning();
    rig.key(Key::W);
    for east in [-150.0, 150.0] {
        click(&mut rig, 0.0, east);
    }
    assert!(is_drawing(&rig));
    rig
}

/// Escape takes away what lies over the map, then ends the drawing of the route.
fn leaves_first(rig: &mut Rig, what: &str) {
    rig.key(Key::Escape);
    rig.frames(2);
    assert!(is_drawing(rig), "{what} was left, and the drawing with it");
    rig.key(Key::Escape);
    rig.frames(2);
    assert!(!is_drawing(rig), "{what} took another press");
}

#[test]
fn a_menu_is_closed_before_the_drawing_of_a_route_is_ended() {
    let mut rig = drawing();
    rig.harness.get_by_label("Patterns").click();
    rig.frames(3);
    rig.harness.get_by_label("Survey an area");
    leaves_first(&mut rig, "the menu");
    assert!(rig.harness.query_by_label("Survey an area").is_none());
}

#[test]
fn the_palette_is_closed_before_the_drawing_of_a_route_is_ended() {
    let mut rig = drawing();
    rig.key_with(egui::Modifiers::COMMAND, Key::K);
    assert_eq!(rig.state()["dialogs"]["palette"], true);
    leaves_first(&mut rig, "the palette");
    assert_eq!(rig.state()["dialogs"]["palette"], false);
}

#[test]
fn a_field_is_left_by_escape_or_enter_before_the_drawing_of_a_route_is_ended() {
    for key in [Key::Escape, Key::Enter] {
        let mut rig = drawing();
        rig.harness.get_by_label("Name of the route").focus();
        rig.frames(2);
        rig.key(key);
        assert!(is_drawing(&rig), "{key:?} was the field's");
        rig.key(key);
        rig.frames(2);
        assert!(!is_drawing(&rig), "{key:?} ends the drawing");
    }
}

#[test]
fn a_drawing_is_ended_before_the_settings_are_closed() {
    let mut rig = drawing();
    rig.harness.get_by_label("Filter settings").click();
    rig.frames(3);
    let are_open = |rig: &Rig| rig.state()["dialogs"]["settings"] == true;
    assert!(are_open(&rig) && is_drawing(&rig));
    rig.key(Key::Escape);
    assert!(are_open(&rig) && !is_drawing(&rig));
    rig.key(Key::Escape);
    assert!(!are_open(&rig));
}

#[test]
fn the_tool_of_boxes_is_left_before_a_way_point_is_let_go() {
    let mut rig = drawing();
    rig.key(Key::Enter);
    click(&mut rig, 0.0, -150.0);
    let way_point = |rig: &Rig| rig.state()["plan"]["way_point"].as_u64();
    assert_eq!(way_point(&rig), Some(0));
    rig.key(Key::N);
    let is_picking = |rig: &Rig| rig.state()["map"]["picking"] == true;
    assert!(is_picking(&rig));
    rig.key(Key::Escape);
    assert!(!is_picking(&rig));
    assert_eq!(way_point(&rig), Some(0));
    rig.key(Key::Escape);
    assert_eq!(way_point(&rig), None);
}

#[test]
fn a_dialog_that_is_closing_lets_the_key_through() {
    let mut rig = drawing();
    rig.key(Key::M);
    rig.frames(3);
    assert_eq!(rig.state()["simulate"]["open"], true);
    leaves_first(&mut rig, "the dialog");
    let mut rig = drawing();
    rig.key(Key::M);
    rig.frames(3);
    let close = rig.harness.get_by_label("Close").rect().center();
    rig.harness.hover_at(close);
    rig.frames(3);
    rig.harness.drag_at(close);
    rig.frames(1);
    rig.harness.drop_at(close);
    let is_open = |rig: &Rig| rig.state()["simulate"]["open"] == true;
    for _ in 0..6 {
        if is_open(&rig) {
            rig.frames(1);
        }
    }
    assert!(!is_open(&rig));
    // In the very frame behind the one in which it was closed.
    rig.key(Key::Escape);
    assert!(!is_drawing(&rig));
}
