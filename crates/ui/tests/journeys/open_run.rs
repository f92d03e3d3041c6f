use egui::Vec2;
use pilotage_jobs::{JobEvent, OpenedFiles};
use pilotage_ui::host::OpenedFile;

use super::reopen::nothing;
use super::support::flight::{flight, mission, run, run_head};
use super::support::{Rig, ScriptedHost, rig_on};

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
