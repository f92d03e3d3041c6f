use egui::accesskit::Role;
use egui::{Key, Modifiers, OutputCommand, Pos2, Vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use super::plan::{click, planning, screen};
use super::support::{Rig, rig};

/// The app while people measure in the Plan workspace.
fn measuring() -> Rig {
    let mut rig = planning();
    rig.key_with(Modifiers::SHIFT, Key::U);
    rig
}

fn measured(rig: &Rig, what: &str) -> serde_json::Value {
    rig.state()["measure"][what].clone()
}

fn count(rig: &Rig) -> Option<usize> {
    measured(rig, "points").as_array().map(Vec::len)
}

fn near(value: &serde_json::Value, expected: f64, tolerance: f64) -> bool {
    value
        .as_f64()
        .is_some_and(|it| (it - expected).abs() < tolerance)
}

fn press(rig: &mut Rig, label: &str) {
    rig.harness
        .get_by_role_and_label(Role::Button, label)
        .click();
    rig.frames(2);
}

/// Clicks a place of the screen, late enough to be no double click.
fn click_at(rig: &mut Rig, at: Pos2) {
    rig.harness.hover_at(at);
    rig.frames(30);
    rig.harness.drag_at(at);
    rig.frames(1);
    rig.harness.drop_at(at);
    rig.frames(2);
}

/// The pointer goes down and up twice within a frame.
fn double_click(rig: &mut Rig, at: Pos2) {
    rig.harness.hover_at(at);
    rig.frames(30);
    for pressed in [true, false, true, false] {
        rig.harness.event(egui::Event::PointerButton {
            pos: at,
            button: egui::PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        });
    }
    rig.frames(3);
}

/// Expected values: `pyproj.Geod(ellps="WGS84")`, pyproj 3.7.2 with PROJ 9.5.1, between the places 0, 60 and 120 m north
/// of 47° N 8° E and 0, 80 and 0 m east of it, on the plane that touches the ellipsoid there.
#[test]
fn clicks_measure_legs_with_their_courses_and_their_sum_in_the_units_of_the_page() {
    let mut rig = measuring();
    for (north, east) in [(0.0, 0.0), (60.0, 80.0), (120.0, 0.0)] {
        click(&mut rig, north, east);
    }
    let legs = measured(&rig, "legs");
    // A click is true to a point of the screen.
    for (leg, course) in [(0, 53.1301), (1, 306.8707)] {
        assert!(near(&legs[leg][0], 100.0, 0.2), "{legs}");
        assert!(near(&legs[leg][1], course, 0.2), "{legs}");
    }
    assert!(near(&measured(&rig, "length"), 200.0, 0.3));
    let sum = rig.harness.get_by_label_contains("Length: ");
    let shown = sum.accesskit_node().value().expect("a text");
    assert!(
        shown.starts_with("Length: 200.") || shown.starts_with("Length: 199."),
        "{shown}"
    );
    rig.harness.get_by_label_contains("Leg 2: 100.");
    rig.key(Key::U);
    rig.harness.get_by_label_contains("Leg 1: 328 ft, 053°");
    rig.harness.get_by_label("Courses in degrees true.");
    let plan = &rig.state()["plan"];
    assert_eq!(
        plan["routes"].as_array().map(Vec::len),
        Some(0),
        "nobody else takes the clicks"
    );
}

#[test]
fn enter_or_a_double_click_ends_the_line_and_adds_no_point() {
    let mut rig = measuring();
    click(&mut rig, 0.0, 0.0);
    let end = screen(&rig, 80.0, 40.0);
    double_click(&mut rig, end);
    assert_eq!(count(&rig), Some(2));
    assert_eq!(measured(&rig, "drawing"), false);
    click(&mut rig, -50.0, 0.0);
    assert_eq!(count(&rig), Some(1), "the next click begins another line");
    click(&mut rig, -50.0, 90.0);
    rig.key(Key::Enter);
    assert_eq!(count(&rig), Some(2));
    assert_eq!(measured(&rig, "drawing"), false);
}

#[test]
fn a_click_on_the_first_point_shows_the_area_and_a_button_copies_it() {
    let mut rig = measuring();
    for (north, east) in [(0.0, 0.0), (120.0, 0.0), (120.0, 90.0), (0.0, 0.0)] {
        click(&mut rig, north, east);
    }
    assert_eq!(
        (count(&rig), measured(&rig, "closed")),
        (Some(3), true.into())
    );
    // Half of 120 m by 90 m; and 120 + 90 + 150 m around it.
    assert!(
        near(&measured(&rig, "area"), 5400.0, 40.0),
        "{}",
        measured(&rig, "area")
    );
    assert!(near(&measured(&rig, "length"), 360.0, 0.6));
    rig.harness.get_by_label_contains("Perimeter: ");
    let area = rig
        .harness
        .get_by_label_contains("Area: ")
        .accesskit_node()
        .value()
        .expect("a text");
    rig.harness
        .get_by_role_and_label(Role::Button, "Copy")
        .click();
    let copied = (0..4).find_map(|_| {
        rig.frames(1);
        let commands = rig.harness.output().platform_output.commands.iter();
        commands.clone().find_map(|it| match it {
            OutputCommand::CopyText(text) => Some(text.clone()),
            _ => None,
        })
    });
    let copied = copied.expect("a text in the clipboard");
    assert_eq!(copied.lines().count(), 5, "{copied}");
    assert!(copied.ends_with(&area), "{copied}");
}

#[test]
fn the_button_on_the_card_closes_the_line_and_clicks_beside_it_add_no_point() {
    let mut rig = measuring();
    for (north, east) in [(0.0, 0.0), (60.0, 0.0), (60.0, 60.0)] {
        click(&mut rig, north, east);
    }
    let title = rig.harness.get_by_label("Measure").rect();
    let beside = title.right_center() + Vec2::new(40.0, 0.0);
    click_at(&mut rig, beside);
    assert_eq!(count(&rig), Some(3), "the card is no map");
    press(&mut rig, "Close the line");
    assert_eq!(measured(&rig, "closed"), true);
}

#[test]
fn points_can_be_dragged_and_the_map_stays_where_it_is() {
    let mut rig = measuring();
    click(&mut rig, 0.0, 0.0);
    click(&mut rig, 0.0, 80.0);
    let before = rig.state()["map"]["center"].clone();
    let [from, to] = [screen(&rig, 0.0, 80.0), screen(&rig, 50.0, 0.0)];
    rig.drag(from, to);
    assert!(
        near(&measured(&rig, "legs")[0][0], 50.0, 0.5),
        "{}",
        measured(&rig, "legs")
    );
    assert_eq!(rig.state()["map"]["center"], before);
    let beside = screen(&rig, -60.0, -60.0);
    rig.drag(beside, beside + Vec2::new(40.0, 0.0));
    assert_ne!(
        rig.state()["map"]["center"],
        before,
        "beside them a drag moves the map"
    );
    assert_eq!(count(&rig), Some(2));
}

#[test]
fn backspace_takes_points_back_and_escape_clears_first_and_leaves_then() {
    let mut rig = rig();
    rig.open_tab("Landmarks");
    rig.key_with(Modifiers::SHIFT, Key::U);
    let middle = rig.rect("/map/rect").center();
    for right in [0.0, 60.0] {
        click_at(&mut rig, middle + Vec2::new(right, 0.0));
    }
    // A landmark is selected meanwhile, in the list.
    rig.harness.get_by_label("Barn").click();
    rig.frames(2);
    assert_eq!(rig.state()["selection"], 1);
    rig.key(Key::Backspace);
    assert_eq!(count(&rig), Some(1));
    let landmarks = rig.state()["landmarks"].as_array().map(Vec::len);
    assert_eq!(landmarks, Some(4), "the landmark is not deleted");
    rig.key(Key::Escape);
    assert_eq!(count(&rig), Some(0));
    rig.key(Key::Escape);
    assert!(rig.state()["measure"].is_null());
}

#[test]
fn escape_is_for_what_lies_over_the_map_first() {
    let mut rig = measuring();
    click(&mut rig, 0.0, 0.0);
    rig.key(Key::Questionmark);
    assert_eq!(rig.state()["dialogs"]["help"], true);
    rig.key(Key::Escape);
    assert_eq!(rig.state()["dialogs"]["help"], false);
    assert_eq!(count(&rig), Some(1));
}

#[test]
fn the_ruler_among_the_controls_begins_and_drawing_a_landmark_leaves() {
    let mut rig = rig();
    press(&mut rig, "Measure distance and area");
    assert_eq!(count(&rig), Some(0));
    rig.key(Key::N);
    assert!(rig.state()["measure"].is_null());
    assert_eq!(rig.state()["map"]["picking"], true);
    press(&mut rig, "Measure distance and area");
    assert_eq!(rig.state()["map"]["picking"], false);
    press(&mut rig, "Stop measuring");
    assert!(rig.state()["measure"].is_null());
}

#[test]
fn escape_leaves_the_selected_span_of_time_until_nothing_is_measured() {
    let mut rig = rig();
    rig.key_with(Modifiers::SHIFT, Key::B);
    let selected = rig.state()["selected"].clone();
    assert!(selected.is_array(), "a span is selected");
    rig.key_with(Modifiers::SHIFT, Key::U);
    rig.key(Key::Escape);
    let state = rig.state();
    assert_eq!(
        (&state["measure"], &state["selected"]),
        (&().into(), &selected)
    );
    rig.key(Key::Escape);
    assert!(rig.state()["selected"].is_null());
}

#[test]
fn undo_while_measuring_takes_the_last_point_back_and_no_edit() {
    let mut rig = measuring();
    let edits = rig.state()["undo"].clone();
    click(&mut rig, 0.0, -50.0);
    click(&mut rig, 0.0, 50.0);
    assert_eq!(count(&rig), Some(2));
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(count(&rig), Some(1));
    assert_eq!(rig.state()["undo"], edits);
}
