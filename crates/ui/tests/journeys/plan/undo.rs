use egui::{Key, Modifiers};

use super::{draw, planning, screen};

#[test]
fn every_way_point_of_a_drawn_route_can_be_taken_back() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 0.0), (0.0, 300.0)]);
    let count = |rig: &super::Rig| {
        let route = rig.state()["plan"]["routes"][0].clone();
        route["way_points"].as_array().map_or(0, Vec::len)
    };
    let mut counts = vec![count(&rig)];
    for _ in 0..3 {
        rig.key_with(Modifiers::COMMAND, Key::Z);
        counts.push(count(&rig));
    }
    assert_eq!(counts, [3, 2, 1, 0]);
    for _ in 0..3 {
        rig.key_with(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    }
    assert_eq!(count(&rig), 3);
}

#[test]
fn after_an_insertion_is_undone_no_other_way_point_is_selected() {
    let mut rig = planning();
    let places = [(0.0, -300.0), (0.0, -100.0), (0.0, 100.0), (0.0, 300.0)];
    draw(&mut rig, &places);
    let (from, to) = (screen(&rig, 0.0, -200.0), screen(&rig, 90.0, -200.0));
    rig.drag(from, to);
    let plan = |rig: &super::Rig| rig.state()["plan"].clone();
    let count = |rig: &super::Rig| {
        let way_points = plan(rig)["routes"][0]["way_points"].clone();
        way_points.as_array().map(Vec::len)
    };
    assert_eq!(
        (count(&rig), plan(&rig)["way_point"].as_u64()),
        (Some(5), Some(1))
    );
    rig.key_with(Modifiers::COMMAND, Key::Z);
    rig.frames(2);
    assert_eq!(
        (count(&rig), plan(&rig)["way_point"].as_u64()),
        (Some(4), None)
    );
    rig.key(Key::Delete);
    rig.frames(2);
    assert_eq!(count(&rig), Some(4), "nothing is selected");
}
