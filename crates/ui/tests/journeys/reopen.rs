use egui::Vec2;
use pilotage_ui::host::OpenedFile;
use pilotage_ui::jobs::{FlightSource, Job, Opened};

use super::support::flight::flight;
use super::support::{Rig, ScriptedHost, rig, rig_on};

fn files(bytes: usize) -> Vec<OpenedFile> {
    let file = |path: &str| OpenedFile {
        path: path.into(),
        content: vec![7; bytes].into(),
    };
    vec![file("trip/flight.json"), file("trip/wind.csv")]
}

/// The app after files with a flight in them were dropped on it.
fn rig_with_a_flight(bytes: usize) -> Rig {
    let mut rig = rig();
    rig.host().opens = Some(Opened {
        key: String::new(),
        flight: Some(flight()),
        map: None,
        terrain: None,
        unplaced: None,
        mission: None,
        run: None,
        imports: Vec::new(),
        beside: None,
        pictures: Vec::new(),
        remarks: Vec::new(),
    });
    rig.host().opened.push(files(bytes));
    rig.frames(6);
    rig.settle();
    rig
}

fn reloaded(rig: &mut Rig) -> Rig {
    let stored = rig.host().stored.clone();
    let host = ScriptedHost {
        stored,
        ..ScriptedHost::default()
    };
    rig_on(host, Vec2::new(1440.0, 900.0))
}

fn flies_files(rig: &mut Rig) -> bool {
    let last = rig.host().last_flight().cloned();
    matches!(
        last,
        Some((
            _,
            Job::Fly {
                flight: FlightSource::Files(_),
                ..
            }
        ))
    )
}

#[test]
fn an_opened_flight_is_there_again_after_a_reload() {
    let mut rig = rig_with_a_flight(100);
    assert!(flies_files(&mut rig));
    let mut again = reloaded(&mut rig);
    assert!(flies_files(&mut again));
    let provided = again.host().jobs.iter().find_map(|(_, job)| match job {
        Job::Provide { files, .. } => Some(files.clone()),
        _ => None,
    });
    let wanted: Vec<_> = files(100)
        .into_iter()
        .map(|f| (f.path, f.content))
        .collect();
    assert_eq!(provided, Some(wanted));
}

#[test]
fn a_flight_of_which_a_file_is_missing_gives_way_to_the_demo_with_a_word() {
    let mut rig = rig_with_a_flight(100);
    rig.host()
        .stored
        .retain(|key, _| !key.starts_with("file 1"));
    let mut again = reloaded(&mut rig);
    assert!(!flies_files(&mut again));
    let title = again.state()["toasts"][0]["title"].clone();
    assert!(
        title.as_str().is_some_and(|t| t.contains("last visit")),
        "{title}"
    );
}

#[test]
fn files_that_are_too_many_are_not_kept_and_the_user_is_told() {
    let mut rig = rig_with_a_flight(40 << 20);
    assert!(!rig.host().stored.keys().any(|key| key.starts_with("file")));
    let told = rig.state()["toasts"].to_string();
    assert!(told.contains("64 MB"), "{told}");
}

#[test]
fn files_of_a_flight_that_was_replaced_are_thrown_away() {
    let mut rig = rig_with_a_flight(100);
    assert!(rig.host().stored.keys().any(|key| key.starts_with("file")));
    rig.harness.state_mut().host.opens = None;
    rig.key_with(egui::Modifiers::COMMAND, egui::Key::K);
    rig.harness.event(egui::Event::Text("built-in demo".into()));
    rig.key(egui::Key::Enter);
    rig.settle();
    rig.settle();
    assert!(!rig.host().stored.keys().any(|key| key.starts_with("file")));
}

#[test]
fn an_opened_flight_lies_within_the_map() {
    let rig = rig_with_a_flight(100);
    let state = rig.state();
    assert_eq!(state["map"]["follow"], false);
    let rect = rig.rect("/map/rect");
    let scale = state["map"]["metres_per_point"].as_f64().expect("a scale");
    let east = state["map"]["center"][1].as_f64().expect("a centre");
    // The flight goes from 400 m west to 560 m east.
    let half = 0.5 * f64::from(rect.width()) * scale;
    assert!(
        east - half < -400.0 && east + half > 560.0,
        "{east} ± {half}"
    );
}
