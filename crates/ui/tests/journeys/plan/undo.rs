use egui::{Key, Modifiers};

use super::{draw, planning};

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
