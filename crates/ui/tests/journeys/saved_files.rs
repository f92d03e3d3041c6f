//! Files and the visit that earlier versions stored open in every later one. The stored files lie in `tests/saved`, in a
//! folder for each version; those of this version are stored by `PILOTAGE_STORE=folder cargo test -p pilotage-ui --test journeys saved_files`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{Key, Modifiers, Vec2};
use pilotage_core::flight::files::ZipFiles;
use pilotage_core::flight::{FrameSource as _, read_flight};
use pilotage_ui::documents::{SESSION_KEY, VIEW_KEY, decode_run, encode_run};
use pilotage_ui::host::OpenedFile;

use super::support::flight::run;
use super::support::{Rig, ScriptedHost, rig, rig_on, written};

/// Steps of the stored run: the form of a step is what has to be read again.
const STEPS: usize = 12;

fn stored(version: &str, name: &str) -> Vec<u8> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/saved");
    let file = Path::new(folder).join(version).join(name);
    std::fs::read(&file).unwrap_or_else(|cause| panic!("{}: {cause}", file.display()))
}

/// Finds a command in the palette and runs it.
fn palette(rig: &mut Rig, words: &str) {
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.harness.event(egui::Event::Text(words.into()));
    rig.frames(2);
    rig.key(Key::Enter);
}

fn open(rig: &mut Rig, name: &str, bytes: Vec<u8>) {
    rig.host().really_open = true;
    rig.host().opened.push(vec![OpenedFile {
        path: name.to_owned(),
        content: bytes.into(),
    }]);
    rig.settle();
}

/// The stored mission: of the invented flight, with a bookmark beside it.
fn is_that_mission(rig: &Rig) {
    let state = rig.state();
    let landmarks = state["landmarks"].as_array().expect("landmarks");
    let names: Vec<_> = landmarks.iter().map(|l| l["name"].as_str()).collect();
    assert_eq!(
        names,
        [Some("Barn"), Some("Chapel"), Some("Pool"), Some("Mill")]
    );
    let origin = [0, 1].map(|i| state["origin"][i].as_f64().expect("degrees"));
    assert!(
        (origin[0] - 47.0).abs() < 1e-9 && (origin[1] - 8.0).abs() < 1e-9,
        "{origin:?}"
    );
    let barn = &landmarks[0];
    let side =
        |a: &str, b: &str| barn[a].as_f64().expect("metres") - barn[b].as_f64().expect("metres");
    assert!((side("north", "south") - 24.0).abs() < 1e-3, "{barn}");
    assert!((side("east", "west") - 30.0).abs() < 1e-3, "{barn}");
}

#[test]
fn a_mission_file_of_version_0_1_opens() {
    let mut rig = rig();
    open(
        &mut rig,
        "mission.pilotage.zip",
        stored("0.1", "mission.pilotage.zip"),
    );
    is_that_mission(&rig);
    let marks = rig.state()["bookmarks"].clone();
    assert_eq!(marks.as_array().map(Vec::len), Some(1), "{marks}");
}

#[test]
fn a_mission_as_geojson_of_version_0_1_opens() {
    let mut rig = rig();
    open(
        &mut rig,
        "mission.geojson",
        stored("0.1", "mission.geojson"),
    );
    is_that_mission(&rig);
}

#[test]
fn a_run_of_version_0_1_opens_and_is_the_same() {
    let read = decode_run("flight.run", &stored("0.1", "flight.run")).expect("a run");
    let mission = super::support::flight::mission();
    let mut expected = run(&mission);
    expected.steps.truncate(STEPS);
    assert_eq!(read.steps, expected.steps);
    assert_eq!(read.landmarks, expected.landmarks);
    let mut rig = rig();
    open(&mut rig, "flight.run", stored("0.1", "flight.run"));
    assert_eq!(rig.state()["run_steps"], STEPS);
}

#[test]
fn a_visit_of_version_0_1_is_taken_up_with_its_mission_its_bookmarks_and_its_look() {
    let mut host = ScriptedHost::default();
    host.stored
        .insert(SESSION_KEY.to_owned(), stored("0.1", "session"));
    host.stored
        .insert(VIEW_KEY.to_owned(), stored("0.1", "view"));
    let mut rig = rig_on(host, Vec2::new(1440.0, 900.0));
    rig.settle();
    is_that_mission(&rig);
    let state = rig.state();
    assert_eq!(state["dark"], false);
    assert_eq!(state["bookmarks"].as_array().map(Vec::len), Some(1));
    assert!(!rig.host().stored.contains_key("unread session"));
}

#[test]
fn a_flight_that_version_0_2_wrote_opens_and_is_the_same_to_the_bit() {
    let bytes = stored("0.2", "flight.zip");
    let files = ZipFiles::open(&bytes).expect("a zip");
    let mut folder = read_flight(Arc::new(files)).expect("a flight");
    assert_eq!(folder.flight, written::flight());
    assert!(folder.notes.is_empty(), "{:?}", folder.notes);
    for index in 0..3 {
        let picture = folder.frames.picture(index).expect("a picture");
        assert_eq!(picture.get(0, 0), written::grey(index));
    }
    let mut rig = rig();
    open(&mut rig, "flight.zip", bytes);
    let toasts = rig.state()["toasts"].to_string();
    assert!(
        toasts.contains("Opened a flight from flight.zip"),
        "{toasts}"
    );
}

/// Stores the files of this version, where somebody asks for them.
#[test]
fn the_files_of_this_version_are_stored_on_request() {
    let Some(folder) = std::env::var_os("PILOTAGE_STORE").map(PathBuf::from) else {
        return;
    };
    std::fs::create_dir_all(&folder).expect("a folder");
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.join(name), bytes).expect(name);
    let mut rig = rig();
    rig.key(Key::B);
    palette(&mut rig, "dark or light");
    rig.key_with(Modifiers::COMMAND, Key::S);
    write(
        "mission.pilotage.zip",
        &rig.host().saved.pop().expect("a mission").1,
    );
    palette(&mut rig, "save the mission alone as geojson");
    write(
        "mission.geojson",
        &rig.host().saved.pop().expect("a mission").1,
    );
    // A mission that was opened is the session's own.
    let file = std::fs::read(folder.join("mission.pilotage.zip")).expect("written above");
    open(&mut rig, "mission.pilotage.zip", file);
    rig.settle();
    let stored = rig.host().stored.clone();
    write("session", &stored[SESSION_KEY]);
    write("view", &stored[VIEW_KEY]);
    let mut flown = run(&super::support::flight::mission());
    flown.steps.truncate(STEPS);
    write("flight.run", &encode_run(&flown).expect("bytes"));
    write("flight.zip", &written::zip());
}
