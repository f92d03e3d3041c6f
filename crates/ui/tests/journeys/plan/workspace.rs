use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

use super::planning;
use crate::support::rig;

#[test]
fn the_first_visit_opens_replay_and_plan_is_a_key_away() {
    let mut rig = rig();
    assert_eq!(rig.state()["workspace"], "Replay");
    rig.key_with(Modifiers::SHIFT, Key::P);
    assert_eq!(rig.state()["workspace"], "Plan");
    rig.key_with(Modifiers::SHIFT, Key::R);
    assert_eq!(rig.state()["workspace"], "Replay");
}

#[test]
fn the_flight_is_flown_again_only_after_planning() {
    let mut rig = planning();
    let flights = rig.host().flights();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Switch Chapel off").click();
    rig.settle();
    assert_eq!(rig.host().flights(), flights);
    rig.open_tab("Replay");
    rig.settle();
    assert_eq!(rig.host().flights(), flights + 1);
}

#[test]
fn the_map_of_the_flight_is_as_it_was_left_after_a_look_at_the_plan() {
    let mut rig = super::super::support::rig();
    rig.settle();
    let flight = rig.state()["map"].clone();
    assert_eq!(flight["follow"], true);
    rig.open_tab("Plan");
    rig.settle();
    let plan = rig.state()["map"].clone();
    assert_ne!(plan["metres_per_point"], flight["metres_per_point"]);
    rig.open_tab("Replay");
    rig.settle();
    let back = rig.state()["map"].clone();
    for key in ["metres_per_point", "follow"] {
        assert_eq!(back[key], flight[key], "{key}");
    }
    rig.open_tab("Plan");
    rig.settle();
    let again = rig.state()["map"].clone();
    for key in ["metres_per_point", "center", "follow"] {
        assert_eq!(again[key], plan[key], "{key}");
    }
}
