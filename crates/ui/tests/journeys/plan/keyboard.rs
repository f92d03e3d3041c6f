use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

use super::{draw, place, planning};

#[test]
fn a_route_is_made_and_moved_without_a_pointer() {
    let mut rig = planning();
    rig.key(Key::I);
    rig.key(Key::I);
    rig.key(Key::Enter);
    rig.frames(2);
    let row = "Way-point 2: course –, 0 m, 0:00";
    let row = rig
        .harness
        .get_by(|n| n.label().is_some_and(|l| l.starts_with(row)));
    row.focus();
    rig.frames(2);
    let (_, before) = place(&rig, 1);
    rig.key_with(Modifiers::SHIFT, Key::ArrowRight);
    rig.key(Key::ArrowRight);
    assert!((place(&rig, 1).1 - before - 11.0).abs() < 1e-6);
    rig.key(Key::Insert);
    let count = rig.state()["plan"]["routes"][0]["way_points"]
        .as_array()
        .map(Vec::len);
    assert_eq!(count, Some(3));
}

#[test]
fn delete_on_a_row_deletes_one_way_point_and_not_the_route_with_it() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    let row = |number: usize| format!("Way-point {number}: ");
    let focus = |rig: &mut super::Rig, number| {
        let name = row(number);
        let found = rig
            .harness
            .get_by(|n| n.label().is_some_and(|l| l.starts_with(&name)));
        found.focus();
        rig.frames(2);
    };
    focus(&mut rig, 2);
    rig.key(Key::Enter);
    assert_eq!(rig.state()["plan"]["way_point"], 1);
    rig.key(Key::Delete);
    rig.frames(2);
    let left = rig.state()["plan"]["routes"][0]["way_points"].clone();
    assert_eq!(left.as_array().map(Vec::len), Some(1));
    // The last one goes with its route.
    focus(&mut rig, 1);
    rig.key(Key::Delete);
    rig.frames(2);
    let left = rig.state()["plan"]["routes"].clone();
    assert_eq!(left.as_array().map(Vec::len), Some(0));
}

#[test]
fn the_place_that_enter_takes_is_marked_on_the_map() {
    let mut rig = planning();
    let is_marked = |rig: &super::Rig| rig.state()["map"]["middle"] == true;
    let focus = |rig: &mut super::Rig| {
        rig.harness
            .get_by_role_and_label(egui::accesskit::Role::Canvas, "Map")
            .focus();
        rig.frames(2);
    };
    focus(&mut rig);
    assert!(!is_marked(&rig), "nothing takes it");
    rig.key_with(Modifiers::SHIFT, Key::F);
    rig.settle();
    focus(&mut rig);
    assert!(is_marked(&rig), "an end of a route to be found");
    rig.key(Key::Escape);
    rig.frames(2);
    assert!(!is_marked(&rig));
    rig.key(Key::N);
    focus(&mut rig);
    assert!(is_marked(&rig), "the box of a landmark");
    rig.key(Key::Enter);
    rig.frames(3);
    assert!(!is_marked(&rig));
    rig.key(Key::Escape);
    rig.frames(2);
    rig.key(Key::W);
    focus(&mut rig);
    assert!(is_marked(&rig), "a way-point");
}
