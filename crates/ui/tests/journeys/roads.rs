use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

use super::plan::{click, planning, screen};
use super::support::Rig;

/// The app while people draw the first road of a mission.
fn drawing() -> Rig {
    let mut rig = planning();
    rig.key_with(Modifiers::SHIFT, Key::Y);
    rig.frames(2);
    rig
}

fn draw(rig: &mut Rig, places: &[(f64, f64)]) {
    for (north, east) in places {
        click(rig, *north, *east);
    }
    rig.key(Key::Enter);
    rig.frames(3);
}

fn of(rig: &Rig, what: &str) -> serde_json::Value {
    rig.state()["roads"][what].clone()
}

fn course(rig: &Rig) -> Vec<[f64; 2]> {
    let course = of(rig, "selected")["course"].clone();
    serde_json::from_value(course).expect("a selected road")
}

fn press(rig: &mut Rig, label: &str) {
    rig.harness
        .get_by_role_and_label(Role::Button, label)
        .click();
    rig.frames(3);
}

#[test]
fn clicks_and_enter_draw_a_road_and_undo_takes_it_back() {
    let mut rig = drawing();
    draw(&mut rig, &[(0.0, -80.0), (20.0, 0.0), (0.0, 80.0)]);
    assert_eq!(of(&rig, "count"), 1);
    assert_eq!(of(&rig, "classes")["residential"], 1);
    let course = course(&rig);
    assert_eq!(course.len(), 3);
    // A click is true to a point of the screen.
    assert!(
        (course[1][0] - 20.0).abs() < 2.0 && course[1][1].abs() < 2.0,
        "{course:?}"
    );
    let routes = rig.state()["plan"]["routes"].as_array().map(Vec::len);
    assert_eq!(routes, Some(0), "nobody else takes the clicks");
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(of(&rig, "count"), 0);
    assert_eq!(of(&rig, "selected"), serde_json::Value::Null);
}

#[test]
fn a_point_near_that_of_another_road_is_put_on_it() {
    let mut rig = drawing();
    draw(&mut rig, &[(0.0, -80.0), (0.0, 80.0)]);
    let end = course(&rig)[1];
    rig.key(Key::Enter);
    let state = rig.state();
    let scale = state["map"]["metres_per_point"].as_f64().expect("a scale");
    draw(
        &mut rig,
        &[(end[0] - 4.0 * scale, end[1] + 6.0 * scale), (80.0, 80.0)],
    );
    assert_eq!(of(&rig, "count"), 2);
    assert_eq!(course(&rig)[0], end);
}

#[test]
fn a_road_that_is_drawn_onto_the_middle_of_another_crosses_it_and_the_crossing_is_dragged_as_one() {
    let mut rig = drawing();
    draw(&mut rig, &[(0.0, -80.0), (0.0, 80.0)]);
    rig.key(Key::Enter);
    let state = rig.state();
    let scale = state["map"]["metres_per_point"].as_f64().expect("a scale");
    draw(&mut rig, &[(60.0, 30.0), (5.0 * scale, 30.0)]);
    let crossing = course(&rig)[1];
    assert!(crossing[0].abs() < 2.0, "{crossing:?}");
    click(&mut rig, 0.0, -40.0);
    let through = course(&rig);
    assert_eq!((through.len(), through[1]), (3, crossing));
    let [from, to] = [screen(&rig, 0.0, 30.0), screen(&rig, -30.0, 30.0)];
    rig.drag(from, to);
    let moved = course(&rig)[1];
    assert!((moved[0] + 30.0).abs() < 3.0, "{moved:?}");
    click(&mut rig, 40.0, 30.0);
    assert_eq!(course(&rig)[1], moved, "both roads have the moved point");
    rig.key_with(Modifiers::COMMAND, Key::Z);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    click(&mut rig, 0.0, -40.0);
    assert_eq!((of(&rig, "count"), course(&rig).len()), (1.into(), 2));
}

#[test]
fn points_are_dragged_added_and_deleted_each_in_one_step() {
    let mut rig = drawing();
    draw(&mut rig, &[(0.0, -80.0), (0.0, 80.0)]);
    let [from, to] = [screen(&rig, 0.0, 0.0), screen(&rig, 40.0, 0.0)];
    rig.drag(from, to);
    let bent = course(&rig);
    assert_eq!(bent.len(), 3, "the middle of a piece became a point");
    assert!((bent[1][0] - 40.0).abs() < 3.0, "{bent:?}");
    rig.key(Key::Delete);
    assert_eq!(
        course(&rig).len(),
        2,
        "the point that was dragged is selected"
    );
    for length in [3, 2] {
        rig.key_with(Modifiers::COMMAND, Key::Z);
        assert_eq!(course(&rig).len(), length);
    }
}

#[test]
fn a_road_is_split_at_its_selected_point_joined_again_and_deleted() {
    let mut rig = drawing();
    draw(&mut rig, &[(0.0, -80.0), (0.0, 0.0), (0.0, 80.0)]);
    click(&mut rig, 0.0, 0.0);
    assert_eq!(of(&rig, "point"), 1);
    press(&mut rig, "Split");
    assert_eq!(of(&rig, "count"), 2);
    click(&mut rig, 0.0, 40.0);
    assert_eq!(course(&rig).len(), 2);
    press(&mut rig, "Join");
    assert_eq!((of(&rig, "count"), course(&rig).len()), (1.into(), 3));
    press(&mut rig, "Delete");
    assert_eq!(of(&rig, "count"), 0);
}

#[test]
fn roads_that_do_not_meet_are_joined_by_a_click() {
    let mut rig = drawing();
    draw(&mut rig, &[(0.0, -80.0), (0.0, -20.0)]);
    rig.key(Key::Enter);
    draw(&mut rig, &[(0.0, 20.0), (0.0, 80.0)]);
    press(&mut rig, "Join");
    assert_eq!(of(&rig, "joining"), true);
    click(&mut rig, 0.0, -50.0);
    assert_eq!((of(&rig, "count"), course(&rig).len()), (1.into(), 4));
}

#[test]
fn the_width_is_set_in_the_units_of_the_page() {
    let mut rig = drawing();
    draw(&mut rig, &[(0.0, -80.0), (0.0, 80.0)]);
    super::plan::set(&mut rig, "Width of the road", 7.5);
    assert_eq!(of(&rig, "selected")["width"], 7.5);
    rig.key(Key::U);
    super::plan::set(&mut rig, "Width of the road", 20.0);
    let width = of(&rig, "selected")["width"].as_f64().expect("a width");
    assert!((width - 6.096).abs() < 1e-9, "{width}");
}

#[test]
fn escape_leaves_step_by_step() {
    let mut rig = drawing();
    click(&mut rig, 0.0, -80.0);
    assert_eq!(of(&rig, "drawing"), 1);
    rig.key(Key::Escape);
    assert_eq!(of(&rig, "drawing"), 0);
    rig.key(Key::Escape);
    assert_eq!(of(&rig, "drawing"), serde_json::Value::Null);
    rig.key(Key::Escape);
    assert_eq!(of(&rig, "on"), false);
}

#[test]
fn escape_ends_a_road_and_keeps_the_points_that_were_drawn() {
    let mut rig = drawing();
    for (north, east) in [(0.0, -80.0), (40.0, -80.0), (80.0, -60.0)] {
        click(&mut rig, north, east);
    }
    rig.key(Key::Escape);
    rig.frames(2);
    assert_eq!(of(&rig, "drawing"), serde_json::Value::Null);
    let course = of(&rig, "selected")["course"].clone();
    assert_eq!(course.as_array().map(Vec::len), Some(3));
    rig.key_with(Modifiers::COMMAND, Key::Z);
    rig.frames(2);
    assert_eq!(of(&rig, "selected"), serde_json::Value::Null);
}

#[test]
fn another_tool_and_closing_the_card_end_a_road_and_keep_it() {
    for leaves in [
        |rig: &mut Rig| rig.key_with(Modifiers::SHIFT, Key::U),
        |rig: &mut Rig| rig.key_with(Modifiers::SHIFT, Key::Y),
        |rig: &mut Rig| rig.key(Key::N),
    ] {
        let mut rig = drawing();
        for (north, east) in [(0.0, -80.0), (40.0, -80.0), (80.0, -60.0)] {
            click(&mut rig, north, east);
        }
        leaves(&mut rig);
        rig.frames(3);
        assert_eq!(
            (of(&rig, "on"), of(&rig, "count")),
            (false.into(), 1.into())
        );
    }
}

#[test]
fn a_name_that_is_typed_is_one_step() {
    let mut rig = drawing();
    draw(&mut rig, &[(0.0, -80.0), (0.0, 80.0)]);
    rig.harness.get_by_label("Name of the road").focus();
    rig.frames(2);
    for letter in ["M", "i", "l", "l"] {
        rig.harness.event(egui::Event::Text(letter.to_owned()));
        rig.frames(2);
    }
    rig.key(Key::Enter);
    rig.frames(2);
    assert_eq!(of(&rig, "selected")["name"], "Mill");
    rig.key_with(Modifiers::COMMAND, Key::Z);
    rig.frames(2);
    assert_eq!(of(&rig, "selected")["name"], "");
}

#[test]
fn another_tool_of_the_map_takes_turns_with_it() {
    let mut rig = drawing();
    rig.key_with(Modifiers::SHIFT, Key::U);
    rig.frames(2);
    assert_eq!(of(&rig, "on"), false);
    assert!(rig.state()["measure"].is_object());
    rig.key_with(Modifiers::SHIFT, Key::Y);
    rig.frames(2);
    assert_eq!(of(&rig, "on"), true);
    assert!(rig.state()["measure"].is_null());
}

#[test]
fn undo_while_a_road_is_drawn_takes_its_last_point_back_and_no_other_edit() {
    let mut rig = drawing();
    draw(&mut rig, &[(0.0, -80.0), (0.0, 80.0)]);
    rig.key(Key::Enter);
    click(&mut rig, 60.0, -40.0);
    click(&mut rig, 60.0, 40.0);
    assert_eq!(of(&rig, "drawing"), 2);
    for left in [1, 0] {
        rig.key_with(Modifiers::COMMAND, Key::Z);
        assert_eq!(
            (of(&rig, "drawing"), of(&rig, "count")),
            (left.into(), 1.into())
        );
    }
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(of(&rig, "count"), 0, "then the road before");
}

#[test]
fn a_point_that_undo_took_back_is_no_longer_selected() {
    let mut rig = drawing();
    draw(&mut rig, &[(0.0, -100.0), (0.0, 20.0), (0.0, 80.0)]);
    let drawn = course(&rig);
    let [from, to] = [screen(&rig, 0.0, -40.0), screen(&rig, 40.0, -40.0)];
    rig.drag(from, to);
    assert_eq!((of(&rig, "point"), course(&rig).len()), (1.into(), 4));
    rig.key_with(Modifiers::COMMAND, Key::Z);
    rig.frames(2);
    assert_eq!(of(&rig, "point"), serde_json::Value::Null);
    // Neither the point that has its number now, nor the road.
    rig.key(Key::Delete);
    rig.frames(2);
    assert_eq!(of(&rig, "count"), 1);
    assert_eq!(course(&rig), drawn);
    click(&mut rig, 0.0, 20.0);
    rig.key(Key::Delete);
    rig.frames(2);
    assert_eq!(course(&rig), [drawn[0], drawn[2]]);
}

#[test]
fn a_road_keeps_its_name_when_another_one_is_clicked_from_its_field() {
    let mut rig = drawing();
    draw(&mut rig, &[(0.0, -80.0), (0.0, 80.0)]);
    rig.key(Key::Enter);
    draw(&mut rig, &[(60.0, -80.0), (60.0, 80.0)]);
    let name = |rig: &mut Rig, text: &str| {
        rig.harness.get_by_label("Name of the road").focus();
        rig.frames(2);
        rig.harness.event(egui::Event::Text(text.to_owned()));
        rig.frames(2);
    };
    name(&mut rig, "High Street");
    click(&mut rig, 0.0, 40.0);
    assert_eq!(of(&rig, "selected")["name"], "");
    name(&mut rig, "Mill Lane");
    click(&mut rig, 60.0, 40.0);
    assert_eq!(of(&rig, "selected")["name"], "High Street");
    rig.key_with(Modifiers::COMMAND, Key::Z);
    click(&mut rig, 0.0, 40.0);
    assert_eq!(of(&rig, "selected")["name"], "", "a step of its own");
    click(&mut rig, 60.0, 40.0);
    assert_eq!(of(&rig, "selected")["name"], "High Street");
}
