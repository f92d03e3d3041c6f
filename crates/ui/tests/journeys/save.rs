use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_ui::documents::decode_run;

use super::support::rig;

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
fn open_asks_for_files() {
    let mut rig = rig();
    rig.harness.get_by_label("Open…").click();
    rig.frames(2);
    assert_eq!(rig.host().file_dialogs, 1);
}
