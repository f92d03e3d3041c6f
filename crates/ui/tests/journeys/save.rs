use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::Job;
use pilotage_ui::documents::decode_run;

use super::support::{flight::mission, rig};

#[test]
fn the_mission_is_offered_as_a_file() {
    let mut rig = rig();
    rig.key_with(Modifiers::COMMAND, Key::S);
    let (name, bytes) = rig.host().saved.pop().expect("a file");
    assert!(name.contains("Invented"), "{name}");
    assert!(name.ends_with(".pilotage.zip"), "{name}");
    let package = pilotage_core::mission::package::read_package(&bytes).expect("a mission file");
    assert!(package.settings["open"].contains("simulation"));
    let mission = package.mission;
    let names: Vec<&str> = mission.landmarks.iter().map(|l| l.name.as_str()).collect();
    assert_eq!(names, ["Barn", "Chapel", "Pool", "Mill"]);
}

#[test]
fn the_run_is_offered_as_a_file_that_can_be_read_again() {
    let mut rig = rig();
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.harness.event(egui::Event::Text("save the run".into()));
    rig.frames(2);
    rig.key(Key::Enter);
    let (name, bytes) = rig.host().saved.pop().expect("a file");
    let run = decode_run(&name, &bytes).expect("a run");
    assert_eq!(
        Some(run.steps.len() as u64),
        rig.state()["run_steps"].as_u64()
    );
}

#[test]
fn the_flown_track_is_offered_for_maps_and_globes() {
    let mut rig = rig();
    rig.key_with(Modifiers::COMMAND, Key::K);
    let words = "save the flown track as csv";
    rig.harness.event(egui::Event::Text(words.into()));
    rig.frames(2);
    rig.key(Key::Enter);
    let (name, bytes) = rig.host().saved.pop().expect("a file");
    assert!(name.ends_with("-track.csv"), "{name}");
    let text = String::from_utf8(bytes).expect("a table");
    let rows = text.lines().count() - 1;
    assert_eq!(Some(rows as u64), rig.state()["run_steps"].as_u64());
    // The run of the rig flies within two kilometres of its mission's origin.
    let origin = mission().origin;
    for row in text.lines().skip(1) {
        let cells: Vec<f64> = row
            .split(',')
            .filter_map(|cell| cell.parse().ok())
            .collect();
        assert!(
            (cells[1] - origin.latitude.to_degrees()).abs() < 0.02,
            "{row}"
        );
        assert!(
            (cells[2] - origin.longitude.to_degrees()).abs() < 0.04,
            "{row}"
        );
    }
}

#[test]
fn open_asks_for_files() {
    let mut rig = rig();
    rig.menu("Open", "Open a flight, map, mission, route or run…");
    rig.frames(2);
    assert_eq!(rig.host().file_dialogs, 1);
}

#[test]
fn a_mission_that_takes_long_to_save_says_so_and_can_be_stopped() {
    let mut rig = rig();
    rig.host().left = Some(|job| matches!(job, Job::Pack(_)));
    rig.key_with(Modifiers::COMMAND, Key::S);
    rig.frames(3);
    rig.harness.get_by_label("Saving the mission");
    rig.harness.get_by_label("Stop computing").click();
    rig.frames(3);
    assert!(rig.harness.query_by_label("Saving the mission").is_none());
    let jobs = rig.host().jobs.iter();
    let packs = jobs.filter(|(_, job)| matches!(job, Job::Pack(_)));
    let packs: Vec<_> = packs.map(|(id, _)| *id).collect();
    assert_eq!(rig.host().cancelled, packs);
    assert!(rig.host().saved.is_empty());
}
