use egui_kittest::kittest::Queryable as _;

use super::{draw, number, planning};

#[test]
fn the_corridor_shrinks_when_a_landmark_is_switched_on() {
    let mut rig = planning();
    // Past the Chapel of the invented flight, which is switched off first.
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Switch Chapel off").click();
    rig.frames(2);
    let chapel = rig.state()["landmarks"][1].clone();
    let north = chapel["north"].as_f64().expect("metres") - 12.0;
    let east = chapel["east"].as_f64().expect("metres") - 15.0;
    rig.open_tab("Route");
    draw(&mut rig, &[(north - 220.0, east), (north + 90.0, east)]);
    let wide = number(&rig, "/prediction/mean_width");
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Switch Chapel on").click();
    rig.frames(2);
    rig.settle();
    let narrow = number(&rig, "/prediction/mean_width");
    assert!(narrow < 0.9 * wide, "{narrow} m after {wide} m");
    assert_eq!(rig.state()["plan"]["prediction"]["fine"], true);
}
