use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::{FlyOrder, Job};

use super::support::rig;

#[test]
fn a_landmark_switched_off_is_left_out_of_the_next_run() {
    let mut rig = rig();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Switch Chapel off").click();
    rig.frames(2);
    rig.settle();
    let Some((
        _,
        Job::Fly(FlyOrder {
            mission: Some(mission),
            ..
        }),
    )) = rig.host().last_flight().cloned()
    else {
        panic!("the flight was not flown again with the mission");
    };
    let chapel = mission.landmarks.iter().find(|l| l.name == "Chapel");
    assert!(chapel.is_some_and(|l| !l.enabled));
    assert!(rig.state()["ghost_steps"].as_u64() > Some(0));
}

#[test]
fn several_edits_in_a_row_are_one_flight() {
    let mut rig = rig();
    let before = rig.host().flights();
    rig.open_tab("Landmarks");
    for label in ["Switch Chapel off", "Switch Pool off", "Switch Mill off"] {
        rig.harness.get_by_label(label).click();
        rig.frames(2);
    }
    rig.settle();
    assert_eq!(rig.host().flights(), before + 1);
}
