use egui::Key;
use pilotage_ui::documents::SESSION_KEY;

use super::plan::{draw, planning};
use super::support::{ScriptedHost, rig_on};

fn told(rig: &super::support::Rig, words: &str) -> bool {
    let state = rig.state();
    let toasts = state["toasts"].as_array().cloned().unwrap_or_default();
    toasts
        .iter()
        .any(|t| t["title"].as_str().is_some_and(|t| t.contains(words)))
}

#[test]
fn a_refused_save_is_told_and_tried_again_without_another_edit() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    rig.host().stored.remove(SESSION_KEY);
    rig.host().refused = vec![SESSION_KEY.into()];
    rig.frames(2);
    assert!(told(&rig, "could not keep everything"));
    for _ in 0..4 {
        rig.settle();
    }
    let stored = rig.host().stored.get(SESSION_KEY).cloned();
    let session = pilotage_ui::documents::Session::decode(&stored.expect("stored again"));
    let mission = session.and_then(|s| s.mission).expect("a mission");
    assert_eq!(mission.routes.len(), 1);
    rig.key(Key::Escape);
}

#[test]
fn a_save_that_broke_off_is_told_at_the_next_visit() {
    let visit_after = |key: &str| {
        let host = ScriptedHost {
            interrupted: vec![key.into()],
            ..ScriptedHost::default()
        };
        rig_on(host, egui::Vec2::new(1440.0, 900.0))
    };
    assert!(told(&visit_after(SESSION_KEY), "last save was broken off"));
    // What is no edit is only done again.
    assert!(!told(&visit_after("view"), "last save was broken off"));
}
