//! Roads drawn with help: legs that follow the road in the map's picture.

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::{Job, JobEvent, JobId};
use serde_json::Value;

use super::plan::{click, planning};
use super::support::Rig;

/// The app while people draw the first road of a mission, which follows that in the picture.
fn following() -> Rig {
    let mut rig = planning();
    rig.key_with(Modifiers::SHIFT, Key::Y);
    rig.frames(2);
    let switch = |rig: &Rig| {
        let label = "Follow the road in the picture";
        rig.harness
            .get_by_role_and_label(Role::CheckBox, label)
            .click();
    };
    switch(&rig);
    rig.frames(3);
    assert_eq!(of(&rig, "follows"), true);
    rig
}

fn of(rig: &Rig, what: &str) -> Value {
    rig.state()["roads"][what].clone()
}

/// Jobs that follow a road, so far.
fn jobs(rig: &mut Rig) -> Vec<JobId> {
    let jobs = rig.host().jobs.iter();
    let own = jobs.filter(|it| matches!(it.1, Job::FollowRoad(_)));
    own.map(|it| it.0).collect()
}

fn leave_unanswered(rig: &mut Rig) {
    rig.host().left = Some(|job| matches!(job, Job::FollowRoad(_)));
}

#[test]
fn a_click_follows_the_road_undo_takes_the_leg_back_and_the_width_is_that_of_the_road() {
    let mut rig = following();
    click(&mut rig, 0.0, -80.0);
    assert!(jobs(&mut rig).is_empty(), "there is nothing to follow yet");
    click(&mut rig, 0.0, 0.0);
    assert_eq!(
        (of(&rig, "drawing"), of(&rig, "awaited")),
        (3.into(), false.into())
    );
    click(&mut rig, 0.0, 80.0);
    assert_eq!(of(&rig, "drawing"), 5);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(of(&rig, "drawing"), 3, "the whole leg");
    rig.key(Key::Enter);
    rig.frames(2);
    let road = of(&rig, "selected");
    assert_eq!(road["width"], 6.2);
    let north = road["course"][1][0].as_f64().expect("metres");
    assert!((north - 20.0).abs() < 2.0, "{road}");
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(of(&rig, "count"), 0, "one step");
}

#[test]
fn shift_and_a_click_goes_straight_and_so_does_everything_once_the_switch_is_off() {
    let mut rig = following();
    click(&mut rig, 0.0, -80.0);
    rig.harness.event(Event::ModifiersChanged(Modifiers::SHIFT));
    click(&mut rig, 0.0, 0.0);
    rig.harness.event(Event::ModifiersChanged(Modifiers::NONE));
    rig.key_with(Modifiers::SHIFT, Key::K);
    assert_eq!(of(&rig, "follows"), false);
    click(&mut rig, 0.0, 80.0);
    assert_eq!((of(&rig, "drawing"), jobs(&mut rig).len()), (3.into(), 0));
}

#[test]
fn a_road_that_is_ended_before_its_leg_is_known_waits_for_it() {
    let mut rig = following();
    leave_unanswered(&mut rig);
    click(&mut rig, 0.0, -80.0);
    click(&mut rig, 0.0, 80.0);
    rig.key(Key::Enter);
    rig.frames(2);
    assert_eq!(
        (of(&rig, "count"), of(&rig, "awaited")),
        (0.into(), true.into())
    );
    let job = jobs(&mut rig)[0];
    rig.host()
        .events
        .push((job, JobEvent::Failed("no file".to_owned())));
    rig.frames(3);
    assert_eq!(of(&rig, "count"), 1);
    assert_eq!(
        of(&rig, "selected")["course"].as_array().map(Vec::len),
        Some(2)
    );
    let toasts = rig.state()["toasts"].to_string();
    assert!(toasts.contains("no file"), "{toasts}");
}

#[test]
fn stop_and_backspace_end_the_work_on_a_leg_that_takes_long() {
    let mut rig = following();
    leave_unanswered(&mut rig);
    click(&mut rig, 0.0, -80.0);
    click(&mut rig, 0.0, 80.0);
    let progress = |rig: &mut Rig, job: JobId| {
        let event = JobEvent::Progress(0.4, "Following the road".to_owned());
        rig.host().events.push((job, event));
        rig.frames(3);
    };
    let first = jobs(&mut rig)[0];
    progress(&mut rig, first);
    assert!(rig.harness.query_by_label("Stop computing").is_none());
    rig.harness.state_mut().host.now += 600.0;
    progress(&mut rig, first);
    rig.harness.get_by_label("Stop computing").click();
    rig.frames(3);
    assert_eq!(
        (of(&rig, "drawing"), of(&rig, "awaited")),
        (2.into(), false.into())
    );
    click(&mut rig, 80.0, 80.0);
    assert_eq!(of(&rig, "awaited"), true);
    rig.key(Key::Backspace);
    assert_eq!(
        (of(&rig, "drawing"), of(&rig, "awaited")),
        (2.into(), false.into())
    );
    let all = jobs(&mut rig);
    assert_eq!(rig.host().cancelled, all);
}
