use super::{draw, place, planning, screen};

#[test]
fn the_middle_of_a_leg_dragged_aside_becomes_a_way_point() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    let depth = rig.state()["undo"].as_u64();
    let (from, to) = (screen(&rig, 0.0, 0.0), screen(&rig, 150.0, 20.0));
    rig.drag(from, to);
    let (north, east) = place(&rig, 1);
    assert!((north - 150.0).abs() < 3.0 && (east - 20.0).abs() < 3.0);
    assert!((place(&rig, 2).1 - 300.0).abs() < 3.0);
    assert_eq!(
        rig.state()["undo"].as_u64(),
        depth.map(|d| d + 1),
        "one step"
    );
}
