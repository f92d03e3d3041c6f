use egui::{Key, Modifiers, Vec2};
use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::{FlightSource, Job, OpenedFiles};
use pilotage_ui::documents::{SESSION_KEY, Session};
use pilotage_ui::host::OpenedFile;
use pilotage_ui::link::{BEFORE_LINK_KEY, LINK_KEY, Link};

use super::reopen::{files, nothing};
use super::support::flight::flight;
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

#[test]
fn work_done_on_a_link_is_kept_aside_when_ones_own_is_brought_back() {
    let mut own = Session::demo();
    own.mission = Some(pilotage_ui::documents::empty_mission());
    let mut host = ScriptedHost::default();
    host.stored.insert(BEFORE_LINK_KEY.into(), own.encode());
    let mut rig = rig_on(host, Vec2::new(1440.0, 900.0));
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Switch Chapel off").click();
    rig.settle();
    command(&mut rig, "open what was open before the link");
    assert_eq!(rig.state()["landmarks"], serde_json::json!([]));
    assert!(rig.host().stored.contains_key(BEFORE_LINK_KEY));
    command(&mut rig, "open what was open before the link");
    assert_eq!(rig.state()["landmarks"][1]["enabled"], false);
}

#[test]
fn a_second_link_takes_nothing_away_from_the_work_that_the_first_put_aside() {
    let mut own = Session::demo();
    let mut mission = pilotage_ui::documents::empty_mission();
    mission.name = "Mine\nin two lines".into();
    own.mission = Some(mission.clone());
    let mut later = Session::demo();
    mission.name = "On the link".into();
    later.mission = Some(mission);
    let mut first = rig();
    command(&mut first, "copy a link to this view");
    let link = first.host().link.clone();
    let mut host = ScriptedHost::default();
    host.stored.insert(BEFORE_LINK_KEY.into(), own.encode());
    host.stored.insert(SESSION_KEY.into(), later.encode());
    host.stored.insert(LINK_KEY.into(), link.into_bytes());
    let mut rig = rig_on(host, Vec2::new(1440.0, 900.0));
    // What is stored leads to both, also at the next visit.
    let mut host = ScriptedHost::default();
    let before = rig.host().stored[BEFORE_LINK_KEY].clone();
    host.stored.insert(BEFORE_LINK_KEY.into(), before);
    let mut next = rig_on(host, Vec2::new(1440.0, 900.0));
    for rig in [&mut rig, &mut next] {
        rig.settle();
        for name in ["On the link", "Mine\nin two lines", "On the link"] {
            command(rig, "open what was open before the link");
            let stored = Session::decode(&rig.host().stored[SESSION_KEY]);
            let mission = stored.and_then(|session| session.mission);
            assert_eq!(mission.map(|it| it.name).as_deref(), Some(name));
        }
    }
}

#[test]
fn a_flight_that_was_opened_at_this_visit_comes_back_with_its_files() {
    let mut own = Session::demo();
    own.mission = Some(pilotage_ui::documents::empty_mission());
    let mut host = ScriptedHost::default();
    host.stored.insert(BEFORE_LINK_KEY.into(), own.encode());
    let mut rig = rig_on(host, Vec2::new(1440.0, 900.0));
    rig.host().opens = Some(OpenedFiles {
        flight: Some(flight()),
        ..nothing()
    });
    rig.host().opened.push(files(100));
    rig.frames(6);
    rig.settle();
    let of_files = FlightSource::Files("opened-1".to_owned());
    let flown =
        |rig: &mut Rig| Session::decode(&rig.host().stored[SESSION_KEY]).map(|it| it.flight);
    command(&mut rig, "open what was open before the link");
    assert_ne!(flown(&mut rig), Some(of_files.clone()));
    command(&mut rig, "open what was open before the link");
    assert_eq!(flown(&mut rig), Some(of_files));
    let toasts = rig.state()["toasts"].to_string();
    assert!(!toasts.contains("not here"), "{toasts}");
    let provided = rig.host().jobs.iter().filter(|(_, job)| {
        matches!(job, Job::Provide(order) if order.key == "opened-1" && !order.files.is_empty())
    });
    assert_eq!(provided.count(), 2);
    assert!(rig.host().stored.contains_key("files of opened-1"));
}

#[test]
fn a_link_is_called_copied_once_it_is() {
    for (is_copied, told) in [(Some(true), 1), (Some(false), 0), (None, 0)] {
        let mut rig = rig();
        rig.host().link_copied = is_copied;
        command(&mut rig, "copy a link to this view");
        let toasts = rig.state()["toasts"].to_string();
        assert_eq!(toasts.matches("Link copied").count(), told, "{is_copied:?}");
    }
}

#[test]
fn files_of_work_that_is_kept_aside_stay_when_others_are_opened_at_a_later_visit() {
    let own = Session {
        flight: FlightSource::Files("opened-1".to_owned()),
        ..Session::demo()
    };
    let mut host = ScriptedHost::default();
    host.stored.insert(BEFORE_LINK_KEY.into(), own.encode());
    let mut rig = rig_on(host, Vec2::new(1440.0, 900.0));
    rig.host().opened.push(vec![OpenedFile {
        path: "other.log".into(),
        content: vec![7; 3].into(),
    }]);
    rig.settle();
    let opened = rig.host().jobs.iter().find_map(|(_, job)| match job {
        Job::Open(order) => Some(order.key.clone()),
        _ => None,
    });
    assert_eq!(opened.as_deref(), Some("opened-2"));
}
