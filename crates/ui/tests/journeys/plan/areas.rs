//! No-fly areas and their holes are drawn, taken up again, cut and deleted.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

use super::{click, draw_area, number, planning, screen};
use crate::support::Rig;

/// The marking that is under way, as its purpose and number of corners.
fn marked(rig: &Rig) -> Option<(String, u64)> {
    let marking = &rig.state()["plan"]["marking"];
    let purpose = marking["purpose"].as_str()?.to_owned();
    Some((purpose, marking["corners"].as_u64()?))
}

fn undo(rig: &mut Rig) {
    rig.harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    rig.settle();
}

/// Cuts a hole of 40 by 40 m about the origin.
fn cut_hole(rig: &mut Rig) {
    rig.harness.get_by_label("Cut a hole").click();
    rig.settle();
    for (north, east) in [(-20.0, -20.0), (20.0, -20.0), (20.0, 20.0), (-20.0, 20.0)] {
        click(rig, north, east);
    }
    rig.key(Key::Enter);
    rig.settle();
}

#[test]
fn a_hole_is_cut_its_corner_dragged_and_it_is_deleted_each_one_step_back() {
    let mut rig = planning();
    draw_area(&mut rig);
    cut_hole(&mut rig);
    let holes = |rig: &Rig| {
        rig.state()["plan"]["areas"][0]["holes"]
            .as_array()
            .map(Vec::len)
    };
    assert_eq!(holes(&rig), Some(1));
    let (from, to) = (screen(&rig, 20.0, 20.0), screen(&rig, 35.0, 20.0));
    rig.drag(from, to);
    rig.settle();
    let moved = number(&rig, "/areas/0/holes/0/2/0");
    assert!((moved - 35.0).abs() < 3.0, "{moved}");
    undo(&mut rig);
    let back = number(&rig, "/areas/0/holes/0/2/0");
    assert!((back - 20.0).abs() < 3.0, "{back}");
    let label = "Delete hole 1 of No-fly area 1";
    rig.harness.get_by_label(label).click();
    rig.settle();
    assert_eq!(holes(&rig), Some(0));
    undo(&mut rig);
    assert_eq!(holes(&rig), Some(1));
}

#[test]
fn a_hole_outside_of_every_area_is_refused_and_its_corners_stay() {
    let mut rig = planning();
    draw_area(&mut rig);
    rig.harness.get_by_label("Cut a hole").click();
    rig.settle();
    for (north, east) in [(0.0, 0.0), (0.0, 100.0), (40.0, 100.0)] {
        click(&mut rig, north, east);
    }
    rig.key(Key::Enter);
    rig.settle();
    assert_eq!(marked(&rig), Some(("Hole".to_owned(), 3)));
    let said = rig.state()["toasts"].to_string();
    assert!(said.contains("inside of a no-fly area"), "{said}");
}

#[test]
fn escape_puts_an_outline_away_and_undo_brings_its_corners_back() {
    let mut rig = planning();
    rig.key_with(Modifiers::SHIFT, Key::A);
    rig.settle();
    for (north, east) in [(-40.0, -40.0), (40.0, -40.0), (40.0, 40.0)] {
        click(&mut rig, north, east);
    }
    rig.key(Key::Escape);
    rig.settle();
    assert_eq!(marked(&rig), None);
    undo(&mut rig);
    assert_eq!(marked(&rig), Some(("NoFlyArea".to_owned(), 3)));
    undo(&mut rig);
    assert_eq!(marked(&rig), Some(("NoFlyArea".to_owned(), 2)));
    // Too few to close it: they stay.
    rig.key(Key::Enter);
    rig.settle();
    assert_eq!(marked(&rig), Some(("NoFlyArea".to_owned(), 2)));
    click(&mut rig, 40.0, 40.0);
    click(&mut rig, -40.0, -40.0);
    assert_eq!(
        rig.state()["plan"]["no_fly"][0],
        3,
        "its first corner closes it"
    );
}

#[test]
fn what_was_put_away_before_another_edit_stays_away() {
    let mut rig = planning();
    draw_area(&mut rig);
    rig.key_with(Modifiers::SHIFT, Key::A);
    rig.settle();
    click(&mut rig, -40.0, 140.0);
    rig.key(Key::Escape);
    rig.settle();
    rig.harness.get_by_label("Delete No-fly area 1").click();
    rig.settle();
    undo(&mut rig);
    assert_eq!(marked(&rig), None);
    assert_eq!(rig.state()["plan"]["no_fly"][0], 4, "the area is back");
}

#[test]
fn an_outline_takes_the_clicks_from_the_choice_of_a_and_b() {
    let mut rig = planning();
    rig.harness.key_press_modifiers(Modifiers::SHIFT, Key::F);
    rig.settle();
    rig.key_with(Modifiers::SHIFT, Key::A);
    rig.settle();
    click(&mut rig, 0.0, 0.0);
    assert_eq!(marked(&rig), Some(("NoFlyArea".to_owned(), 1)));
    assert!(rig.state()["plan"]["find"]["from"].is_null());
}

#[test]
fn a_found_route_is_forgotten_once_an_area_is_drawn_and_with_it_deleted_again() {
    let mut rig = planning();
    rig.harness.key_press_modifiers(Modifiers::SHIFT, Key::F);
    rig.settle();
    click(&mut rig, 0.0, -300.0);
    click(&mut rig, 0.0, 300.0);
    rig.settle();
    rig.harness.get_by_label("Find the route").click();
    rig.settle();
    assert!(number(&rig, "/find/shortest/length") < 640.0);
    draw_area(&mut rig);
    assert!(rig.state()["plan"]["find"]["shortest"].is_null());
    rig.harness.get_by_label("Find the route").click();
    rig.settle();
    assert!(number(&rig, "/find/shortest/length") > 640.0);
    undo(&mut rig);
    assert!(rig.state()["plan"]["find"]["shortest"].is_null());
}

#[test]
fn each_tool_of_the_map_takes_it_from_the_others() {
    let mut rig = planning();
    rig.key_with(Modifiers::SHIFT, Key::Y);
    rig.settle();
    for (north, east) in [(0.0, -80.0), (40.0, -80.0)] {
        click(&mut rig, north, east);
    }
    rig.key_with(Modifiers::SHIFT, Key::A);
    rig.settle();
    let roads = rig.state()["roads"].clone();
    assert_eq!((&roads["on"], &roads["count"]), (&false.into(), &1.into()));
    click(&mut rig, 0.0, 0.0);
    assert_eq!(marked(&rig), Some(("NoFlyArea".to_owned(), 1)));
    rig.key_with(Modifiers::SHIFT, Key::U);
    rig.settle();
    assert_eq!(marked(&rig), None);
    assert!(rig.state()["measure"].is_object());
    rig.key(Key::W);
    rig.settle();
    assert!(rig.state()["measure"].is_null());
    assert_eq!(rig.state()["plan"]["drawing"], true);
    rig.key_with(Modifiers::SHIFT, Key::F);
    rig.settle();
    assert_eq!(rig.state()["plan"]["find"]["pick"], "From");
    rig.key(Key::N);
    rig.settle();
    assert_eq!(rig.state()["plan"]["find"]["pick"], "Nothing");
    assert_eq!(rig.state()["map"]["picking"], true);
}

#[test]
fn what_was_put_away_comes_back_after_another_tool_was_begun_and_left() {
    let mut rig = planning();
    draw_area(&mut rig);
    rig.key_with(Modifiers::SHIFT, Key::A);
    rig.settle();
    for (north, east) in [(-40.0, 140.0), (40.0, 140.0), (40.0, 200.0)] {
        click(&mut rig, north, east);
    }
    // Another purpose, and nothing marked for it.
    rig.harness.get_by_label("Mark a rally point").click();
    rig.settle();
    assert_eq!(marked(&rig), Some(("Rally".to_owned(), 0)));
    undo(&mut rig);
    assert_eq!(marked(&rig), Some(("NoFlyArea".to_owned(), 3)));
    rig.key(Key::Escape);
    rig.settle();
    rig.harness.key_press_modifiers(Modifiers::SHIFT, Key::F);
    rig.settle();
    undo(&mut rig);
    assert_eq!(marked(&rig), Some(("NoFlyArea".to_owned(), 3)));
    assert_eq!(rig.state()["plan"]["no_fly"][0], 4, "the area is untouched");
}

#[test]
fn the_name_typed_for_an_area_is_its_own_though_another_one_is_deleted_next() {
    let mut rig = planning();
    draw_area(&mut rig);
    draw_area(&mut rig);
    draw_area(&mut rig);
    let names = |rig: &Rig| {
        let areas = rig.state()["plan"]["areas"].as_array().cloned();
        let areas = areas.unwrap_or_default().into_iter();
        areas.map(|it| it["name"].clone()).collect::<Vec<_>>()
    };
    let label = "Name of No-fly area 2";
    rig.harness.get_by_label(label).focus();
    rig.frames(2);
    rig.key_with(Modifiers::COMMAND, Key::A);
    rig.harness.event(egui::Event::Text("Airfield".into()));
    rig.frames(2);
    rig.harness.get_by_label("Delete No-fly area 1").click();
    rig.settle();
    assert_eq!(names(&rig), ["Airfield", "No-fly area 3"]);
}
