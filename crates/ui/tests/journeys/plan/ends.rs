//! Take-off, waiting, landing and return, chosen in the column.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

use super::super::support::Rig;
use super::{choose, count, draw, number, planning};

const LINE: [(f64, f64); 2] = [(0.0, -300.0), (0.0, 300.0)];

fn action(rig: &Rig, index: usize) -> String {
    let path = format!("/plan/routes/0/way_points/{index}/action");
    let state = rig.state();
    let action = state.pointer(&path).and_then(serde_json::Value::as_str);
    action.unwrap_or_default().to_owned()
}

fn returns(rig: &Rig) -> bool {
    rig.state()["plan"]["routes"][0]["returns"] == true
}

#[test]
fn a_route_that_returns_has_its_way_back_in_the_table_and_in_the_prediction() {
    let mut rig = planning();
    draw(&mut rig, &LINE);
    assert_eq!(count(&rig, "Return:"), 0);
    let before = number(&rig, "/prediction/length");
    rig.harness
        .get_by_label("Return to the start at the end")
        .click_accesskit();
    rig.settle();
    assert!(returns(&rig));
    assert_eq!(count(&rig, "Return: course 270°, 600 m"), 1);
    let longer = number(&rig, "/prediction/length") - before;
    assert!((350.0..800.0).contains(&longer), "{longer} m");
    rig.harness
        .get_by_label("Land at the last way-point")
        .click_accesskit();
    rig.settle();
    assert!(!returns(&rig));
    assert_eq!(action(&rig, 1), "Land");
    let lies = "landing, 0 m above ground";
    assert_eq!(rig.harness.query_all_by_label_contains(lies).count(), 1);
    assert_eq!(count(&rig, "Return:"), 0);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert!(returns(&rig) && action(&rig, 1) == "FlyBy");
}

#[test]
fn a_way_point_waits_as_long_as_is_said() {
    let mut rig = planning();
    draw(&mut rig, &LINE);
    rig.harness
        .get_by_label("Take off at the start")
        .click_accesskit();
    rig.settle();
    assert_eq!(action(&rig, 0), "TakeOff");
    choose(&mut rig, 2);
    rig.harness
        .get_by_label("What is done at the way-point")
        .click_accesskit();
    rig.frames(3);
    rig.harness.get_by_label("Wait").click();
    rig.settle();
    let waits = "Wait { radius: 80.0, seconds: Some(30.0) }";
    assert_eq!(action(&rig, 1), waits);
    let is_told = |n: &egui_kittest::kittest::AccessKitNode<'_>| {
        n.label()
            .is_some_and(|label| label.contains(", waits 30 s,"))
    };
    assert_eq!(rig.harness.query_all_by(is_told).count(), 1);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(action(&rig, 1), "FlyBy");
}
