use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

use super::{click, draw, place, planning};

#[test]
fn a_route_is_drawn_by_clicks_and_ended_by_enter() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (60.0, 0.0), (0.0, 300.0)]);
    let state = rig.state();
    let route = &state["plan"]["routes"][0];
    assert_eq!(route["way_points"].as_array().map(Vec::len), Some(3));
    assert_eq!(state["plan"]["drawing"], false);
    assert!((place(&rig, 1).0 - 60.0).abs() < 2.0);
    assert_eq!(route["way_points"][1]["frame"], "above ground");
    assert_eq!(state["plan"]["prediction"]["fine"], true);
    let rows = rig.harness.query_all_by(|n| {
        n.label()
            .is_some_and(|l| l.starts_with("Way-point 2: course 0"))
    });
    assert_eq!(rows.count(), 1, "the leg table has a row for it");
}

#[test]
fn a_route_of_one_way_point_is_none() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0)]);
    assert_eq!(
        rig.state()["plan"]["routes"].as_array().map(Vec::len),
        Some(0)
    );
}

#[test]
fn a_route_of_one_way_point_is_none_either_where_the_plan_is_left_meanwhile() {
    let mut rig = planning();
    let depth = rig.state()["undo"].clone();
    rig.key(Key::W);
    click(&mut rig, 0.0, -300.0);
    rig.key_with(Modifiers::SHIFT, Key::R);
    rig.settle();
    let state = rig.state();
    assert_eq!(state["workspace"], "Replay");
    assert_eq!(state["plan"]["routes"].as_array().map(Vec::len), Some(0));
    assert_eq!(state["undo"], depth);
}
