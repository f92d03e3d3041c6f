use egui::{Key, Modifiers};

use super::support::{Rig, rig};

/// The browser's Back or Forward leads to a place.
fn go(rig: &mut Rig, place: &str) {
    rig.host().gone_back = Some(place.to_owned());
    rig.frames(3);
}

#[test]
fn back_and_forward_lead_to_the_workspaces_and_stops_of_the_tour_that_were_open() {
    let mut rig = rig();
    rig.key_with(Modifiers::SHIFT, Key::P);
    rig.open_tab("Learn");
    rig.key(Key::PageDown);
    rig.key(Key::PageDown);
    rig.key_with(Modifiers::SHIFT, Key::R);
    let all = ["Replay", "Plan", "Learn 0", "Learn 1", "Learn 2", "Replay"];
    assert_eq!(rig.host().places, all);
    go(&mut rig, "Learn 1");
    let state = rig.state();
    assert_eq!(
        (&state["workspace"], &state["tour"]["stop"]),
        (&"Learn".into(), &1.into())
    );
    go(&mut rig, "Plan");
    assert_eq!(rig.state()["workspace"], "Plan");
    go(&mut rig, "Learn 2");
    let state = rig.state();
    assert_eq!(
        (&state["workspace"], &state["tour"]["stop"]),
        (&"Learn".into(), &2.into())
    );
    assert_eq!(
        rig.host().places[all.len()..],
        ["Learn 1", "Plan", "Learn 2"]
    );
}

#[test]
fn a_place_that_is_none_any_more_leads_nowhere_or_to_the_last_stop() {
    let mut rig = rig();
    go(&mut rig, "Somewhere");
    assert_eq!(rig.state()["workspace"], "Replay");
    go(&mut rig, "Learn 99");
    let state = rig.state();
    assert_eq!(state["workspace"], "Learn");
    assert!(state["tour"]["stop"].as_u64() < Some(99));
}
