use super::{draw, number, place, planning, screen};

#[test]
fn a_way_point_is_dragged_and_the_prediction_follows() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 0.0), (0.0, 300.0)]);
    let depth = rig.state()["undo"].as_u64();
    let length = number(&rig, "/prediction/length");
    let (from, to) = (screen(&rig, 0.0, 0.0), screen(&rig, 200.0, 0.0));
    rig.drag(from, to);
    assert!((place(&rig, 1).0 - 200.0).abs() < 3.0);
    assert_eq!(
        rig.state()["undo"].as_u64(),
        depth.map(|d| d + 1),
        "one step"
    );
    rig.settle();
    assert!(number(&rig, "/prediction/length") > length + 50.0);
}
