use egui::{Key, Modifiers, Vec2};
use pilotage_ui::documents::{SESSION_KEY, Session};
use pilotage_ui::link::{LINK_KEY, Link};

use super::support::{Rig, ScriptedHost, rig, rig_on};

fn command(rig: &mut Rig, words: &str) {
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.harness.event(egui::Event::Text(words.into()));
    rig.frames(2);
    rig.key(Key::Enter);
    rig.settle();
}

#[test]
fn a_copied_link_leads_to_the_same_view() {
    let mut first = rig();
    first.open_tab("Plan");
    first.settle();
    command(&mut first, "copy a link to this view");
    let link = first.host().link.clone();
    assert!(Link::decode(&link).is_some(), "{link}");
    let mut host = ScriptedHost::default();
    host.stored.insert(LINK_KEY.into(), link.into_bytes());
    let second = rig_on(host, Vec2::new(1440.0, 900.0));
    let (a, b) = (first.state(), second.state());
    assert_eq!(b["workspace"], "Plan");
    for i in 0..2 {
        let metres = |s: &serde_json::Value| s["map"]["center"][i].as_f64().expect("metres");
        assert!(
            (metres(&a) - metres(&b)).abs() < 0.02,
            "{} {}",
            a["map"],
            b["map"]
        );
    }
    assert!(
        (a["time"].as_f64().expect("a time") - b["time"].as_f64().expect("a time")).abs() < 0.02
    );
}

#[test]
fn a_link_leaves_ones_own_work_aside_and_a_command_brings_it_back() {
    let mut first = rig();
    first.key_with(Modifiers::COMMAND, Key::K);
    first.harness.event(egui::Event::Text("copy a link".into()));
    first.frames(2);
    first.key(Key::Enter);
    let link = first.host().link.clone();
    let mut own = Session::demo();
    let mut mission = pilotage_ui::documents::empty_mission();
    mission.name = "Mine".into();
    own.mission = Some(mission);
    let mut host = ScriptedHost::default();
    host.stored.insert(SESSION_KEY.into(), own.encode());
    host.stored.insert(LINK_KEY.into(), link.into_bytes());
    let mut rig = rig_on(host, Vec2::new(1440.0, 900.0));
    rig.settle();
    assert_eq!(rig.state()["landmarks"].as_array().map(Vec::len), Some(4));
    command(&mut rig, "open what was open before the link");
    assert_eq!(rig.state()["landmarks"].as_array().map(Vec::len), Some(0));
    let stored = rig.host().stored[SESSION_KEY].clone();
    let name = Session::decode(&stored)
        .and_then(|s| s.mission)
        .map(|m| m.name);
    assert_eq!(name.as_deref(), Some("Mine"));
}
