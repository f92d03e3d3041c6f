use egui_kittest::kittest::Queryable as _;

use super::support::{Rig, rig};

#[test]
fn the_tour_is_the_next_step_in_the_demo_and_left_again() {
    let mut rig = rig();
    assert_eq!(rig.state()["tour"], serde_json::Value::Null);
    let tab = rig.state()["side_tab"].clone();
    rig.harness.get_by_label("Take the tour").click();
    rig.frames(3);
    assert!(rig.harness.query_by_label("Take the tour").is_none());
    assert_eq!(rig.state()["workspace"], "Learn");
    assert_eq!(rig.state()["tour"]["stop"], 0);
    rig.harness.get_by_label("Next").click();
    rig.frames(3);
    let state = rig.state();
    assert_eq!(state["tour"]["stop"], 1);
    let camera = &state["drawn"]["camera"]["cursor"];
    assert_eq!(*camera, state["time"], "the picture stays beside the tour");
    rig.harness.get_by_label("Leave the tour").click();
    rig.frames(3);
    let state = rig.state();
    assert_eq!(state["workspace"], "Replay");
    assert_eq!(state["side_tab"], tab);
    assert_eq!(state["tour"], serde_json::Value::Null);
}

#[test]
fn advice_that_was_dismissed_does_not_come_back() {
    let mut rig = rig();
    rig.harness.get_by_label("Dismiss the advice").click();
    rig.frames(3);
    let advice = |rig: &Rig| rig.harness.query_by_label("Dismiss the advice").is_some();
    assert!(!advice(&rig));
    rig.open_tab("Learn");
    rig.open_tab("Replay");
    assert!(!advice(&rig));
}
