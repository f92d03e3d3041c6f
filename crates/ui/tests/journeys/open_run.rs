use egui::Vec2;
use pilotage_jobs::{JobEvent, OpenedFiles};
use pilotage_ui::host::OpenedFile;

use super::outage::rounds;
use super::reopen::nothing;
use super::support::flight::{flight, mission, run, run_head};
use super::support::{Rig, ScriptedHost, rig, rig_on};

/// The pictures of the frames `which`, as the flight tells them.
fn pictures(which: std::ops::Range<usize>) -> Vec<JobEvent> {
    let taken = |index| JobEvent::FrameTaken {
        index,
        digest: None,
    };
    which.map(taken).collect()
}

fn say(rig: &mut Rig, events: impl IntoIterator<Item = JobEvent>) {
    let (id, _) = rig.host().last_flight().cloned().expect("a flight");
    let told = events.into_iter().map(|event| (id, event));
    rig.host().events.extend(told);
    rig.frames(3);
}

/// A run that is opened while its flight is under way takes the place of what is flown, and the pictures go on.
#[test]
fn the_pictures_go_on_when_a_run_is_opened_while_it_is_flown() {
    let host = ScriptedHost {
        silent_flights: true,
        ..ScriptedHost::default()
    };
    let mut rig = rig_on(host, Vec2::new(1440.0, 900.0));
    rig.frames(3);
    let mut flown = run(&mission()).steps;
    let rest = flown.split_off(10);
    let begun = [
        JobEvent::Flight(Box::new(flight())),
        JobEvent::Mission(Box::new(mission())),
        JobEvent::RunStarted(Box::new(run_head(&mission()))),
        JobEvent::Steps(flown),
    ];
    say(&mut rig, begun.into_iter().chain(pictures(0..1)));
    assert_eq!(rig.state()["run_steps"], 10);

    let mut opened = run(&mission());
    opened.steps.truncate(25);
    rig.host().opens = Some(OpenedFiles {
        run: Some(opened),
        ..nothing()
    });
    rig.host().opened.push(vec![OpenedFile {
        path: "invented.run".into(),
        content: vec![7; 3].into(),
    }]);
    rig.frames(6);
    assert_eq!(rig.state()["run_steps"], 25);
    assert_eq!(rig.state()["run_complete"], true);

    let progress = JobEvent::Progress(0.5, "Flying".into());
    say(&mut rig, [progress]);
    assert_eq!(rig.state()["job"]["words"], "Taking the pictures");
    let count = flight().frames.len();
    let more = [JobEvent::Steps(rest)]
        .into_iter()
        .chain(pictures(1..count));
    say(&mut rig, more.chain([JobEvent::Finished]));
    let state = rig.state();
    assert_eq!(state["pictures"], count);
    assert_eq!(state["run_steps"], 25, "the run out of the file stays");
    assert_eq!(state["ghost_steps"], 0, "what was flown so far is no run");
    assert!(state["job"].is_null(), "{}", state["job"]);
}

/// Its errors would be measured against the truth of the flight that is open.
#[test]
fn a_run_of_another_flight_is_not_shown_over_the_one_that_is_open() {
    let mut rig = rig();
    let before = rig.state();
    let mut other = run(&mission());
    other.name = "Survey of May".to_owned();
    for step in &mut other.steps {
        step.control.height += 30.0;
    }
    rig.host().opens = Some(OpenedFiles {
        run: Some(other),
        ..nothing()
    });
    rig.host().opened.push(vec![OpenedFile {
        path: "may.run".into(),
        content: vec![7; 3].into(),
    }]);
    rig.frames(6);
    let state = rig.state();
    let told = state["toasts"].to_string();
    assert!(told.contains("Survey of May"), "{told}");
    assert!(!told.contains("holds nothing"), "{told}");
    assert_eq!(state["ghost_steps"], before["ghost_steps"]);
    assert_eq!(state["accepted"], before["accepted"]);
}

/// A run that was really flown holds what the log says, to the last bit.
#[test]
fn a_saved_run_opens_over_its_flight_and_not_over_another() {
    let mut rig = rig();
    rig.host().really_open = true;
    let open = |rig: &mut Rig, name: &str, bytes: Vec<u8>| {
        rig.host().opened.push(vec![OpenedFile {
            path: name.to_owned(),
            content: bytes.into(),
        }]);
        rig.settle();
    };
    open(&mut rig, "rounds.log", rounds());
    let steps = rig.state()["run_steps"].clone();
    assert!(steps.as_u64() > Some(1000), "{steps}");
    rig.key_with(egui::Modifiers::COMMAND, egui::Key::K);
    rig.harness.event(egui::Event::Text("save the run".into()));
    rig.frames(2);
    rig.key(egui::Key::Enter);
    let (name, bytes) = rig.host().saved.pop().expect("a file");
    open(&mut rig, "renamed.log", rounds());
    open(&mut rig, &name, bytes.clone());
    assert_eq!(rig.state()["ghost_steps"], steps, "it was shown");
    let faster = String::from_utf8(rounds()).expect("a text log");
    let faster = faster.replace(", 20\n", ", 21\n");
    open(&mut rig, "faster.log", faster.into_bytes());
    let ghost = rig.state()["ghost_steps"].clone();
    open(&mut rig, &name, bytes);
    let told = rig.state()["toasts"].to_string();
    assert!(told.contains("made of another flight"), "{told}");
    assert_eq!(rig.state()["ghost_steps"], ghost);
}
