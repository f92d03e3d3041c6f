use egui::Key;
use pilotage_jobs::{Beside, FlightSource, FlyOrder, Job, OpenedFiles, SimulationOptions};
use pilotage_ui::host::OpenedFile;

use super::outage::rounds;
use super::reopen::nothing;
use super::support::flight::mission;
use super::support::{Rig, rig};

/// Opens a mission file that was saved beside this.
fn open_mission(rig: &mut Rig, simulation: Option<SimulationOptions>, bookmarks: Vec<f64>) {
    rig.host().really_open = false;
    rig.host().opens = Some(OpenedFiles {
        mission: Some(mission()),
        beside: Some(Beside {
            simulation,
            bookmarks,
            ..Beside::default()
        }),
        ..nothing()
    });
    rig.host().opened.push(vec![OpenedFile {
        path: "mission.pilotage.zip".into(),
        content: vec![7; 3].into(),
    }]);
    rig.settle();
}

fn rig_with_rounds() -> Rig {
    let mut rig = rig();
    rig.host().really_open = true;
    rig.host().opened.push(vec![OpenedFile {
        path: "rounds.log".to_owned(),
        content: rounds().into(),
    }]);
    rig.settle();
    rig
}

#[test]
fn bookmarks_of_a_mission_file_come_with_the_flight_that_it_names() {
    let mut rig = rig();
    rig.key(Key::B);
    let options = SimulationOptions {
        seed: 7,
        ..SimulationOptions::demo()
    };
    open_mission(&mut rig, Some(options.clone()), vec![4.0]);
    let flown = rig.host().last_flight().cloned();
    let Some((_, Job::Fly(FlyOrder { flight, .. }))) = flown else {
        panic!("{flown:?}");
    };
    assert_eq!(flight, FlightSource::Simulated(options.clone()));
    assert_eq!(rig.state()["bookmarks"], serde_json::json!([4.0]));
    // The flight is open now: those of the file come beside those that were set since.
    rig.key(Key::End);
    rig.key(Key::B);
    open_mission(&mut rig, Some(options), vec![4.0, 9.0]);
    let marks = rig.state()["bookmarks"].clone();
    assert_eq!(marks.as_array().map(Vec::len), Some(3), "{marks}");
}

#[test]
fn bookmarks_of_a_recorded_flight_stay_when_a_mission_of_no_known_flight_is_opened() {
    let mut rig = rig_with_rounds();
    let end = rig.state()["span"][1].as_f64().expect("a time");
    open_mission(&mut rig, None, vec![20.0, end + 100.0]);
    assert_eq!(rig.state()["bookmarks"], serde_json::json!([]), "not its");
    open_mission(&mut rig, None, vec![20.0]);
    assert_eq!(rig.state()["bookmarks"], serde_json::json!([20.0]));
    for theirs in [Vec::new(), vec![30.0]] {
        open_mission(&mut rig, None, theirs);
        assert_eq!(rig.state()["bookmarks"], serde_json::json!([20.0]));
    }
}

#[test]
fn a_bookmark_is_dropped_and_found_again() {
    let mut rig = rig();
    rig.key_with(egui::Modifiers::SHIFT, Key::ArrowRight);
    rig.key(Key::B);
    let marked = rig.state()["time"].as_f64().expect("a time");
    rig.key(Key::Home);
    assert_eq!(rig.state()["time"], 0.0);
    rig.key(Key::CloseBracket);
    assert_eq!(rig.state()["time"].as_f64(), Some(marked));
}
