use egui_kittest::kittest::Queryable as _;

use egui::Vec2;
use pilotage_ui::host::TOUR_KEY;

use super::support::{Rig, ScriptedHost, rig, rig_on};

#[test]
fn a_link_of_a_lesson_leads_to_its_stop_of_the_tour() {
    let mut host = ScriptedHost::default();
    host.stored.insert(TOUR_KEY.into(), b"your-turn".to_vec());
    let rig = rig_on(host, Vec2::new(1440.0, 900.0));
    assert_eq!(rig.state()["workspace"], "Learn");
    assert_eq!(rig.state()["tour"]["title"], "Your turn");
}

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
