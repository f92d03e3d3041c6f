use egui_kittest::kittest::Queryable as _;

use super::{draw, number, planning};

#[test]
fn a_measured_landmark_is_believed_instead_of_the_assumption() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label_contains("Chapel: ").click();
    rig.settle();
    rig.harness
        .get_by_label("Measure how well it is found")
        .click();
    rig.settle();
    assert_eq!(number(&rig, "/measured/0/id"), 2.0);
    assert!((number(&rig, "/measured/0/probability") - 0.45).abs() < 1e-9);
    rig.harness.get_by_label("found 45 % of the time");
    rig.harness.get_by_label("wrong 3 %");
}

#[test]
fn all_landmarks_are_measured_one_after_the_other() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Measure all").click();
    for _ in 0..4 {
        rig.settle();
    }
    let measured = rig.state()["plan"]["measured"].as_array().map(Vec::len);
    assert_eq!(measured, Some(4));
}
