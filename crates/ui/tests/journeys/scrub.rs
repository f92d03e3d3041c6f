use egui::accesskit::{Action, ActionData, ActionRequest, Role, TreeId};
use egui::{Event, Key, Modifiers, Pos2, Vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use pilotage_core::navigator::StepReport;
use pilotage_jobs::{JobEvent, JobId};

use super::support::flight::{flight, mission, run, run_head};
use super::support::{Rig, ScriptedHost, rig, rig_on};

#[test]
fn a_drag_on_the_timeline_moves_the_time_cursor() {
    let mut rig = rig();
    let track = rig.rect("/timeline");
    let at = |part: f32| Pos2::new(track.left() + part * track.width(), track.center().y);
    rig.drag(at(0.1), at(0.5));
    let state = rig.state();
    let time = state["time"].as_f64().expect("a time");
    let span = state["span"][1].as_f64().expect("a span");
    assert!((time / span - 0.5).abs() < 0.02, "{time} of {span}");
    let step = state["step"]["time"].as_f64().expect("a step");
    assert!((step - time).abs() < 0.2, "the views follow");
}

#[test]
fn arrows_step_by_camera_frames() {
    let mut rig = rig();
    rig.key(Key::Home);
    rig.key(Key::ArrowRight);
    rig.key(Key::ArrowRight);
    assert_eq!(rig.state()["time"].as_f64(), Some(1.0));
    rig.key(Key::ArrowLeft);
    assert_eq!(rig.state()["time"].as_f64(), Some(0.5));
    rig.key(Key::End);
    assert_eq!(rig.state()["time"], rig.state()["span"][1]);
}

/// A flight of 60 s of which half is flown so far: its job, and the other half.
pub fn half_flown() -> (Rig, JobId, Vec<StepReport>) {
    let host = ScriptedHost {
        silent_flights: true,
        ..ScriptedHost::default()
    };
    let mut rig = rig_on(host, Vec2::new(1440.0, 900.0));
    let id = rig.host().last_flight().expect("a flight").0;
    let mission = mission();
    let mut steps = run(&mission).steps;
    let rest = steps.split_off(steps.len() / 2);
    let events = [
        JobEvent::Flight(Box::new(flight())),
        JobEvent::Mission(Box::new(mission.clone())),
        JobEvent::RunStarted(Box::new(run_head(&mission))),
        JobEvent::Steps(steps),
    ];
    rig.host().events.extend(events.map(|event| (id, event)));
    rig.frames(3);
    (rig, id, rest)
}

/// Time of the last step that `half_flown` has, seconds.
pub const HALF: f64 = 299.0 * 0.1;

#[test]
fn while_it_flies_the_end_is_the_end_of_what_is_flown() {
    let (mut rig, ..) = half_flown();
    let last = HALF;
    rig.key(Key::End);
    let state = rig.state();
    assert_eq!(state["time"].as_f64(), Some(last));
    assert!(state["span"][1].as_f64() > Some(last), "it goes on");
    // Nor does a click beyond it show what was known last as though it were of then.
    rig.key(Key::Home);
    let track = rig.rect("/timeline");
    let beyond = Pos2::new(track.left() + 0.9 * track.width(), track.center().y);
    rig.drag(beyond - Vec2::new(5.0, 0.0), beyond);
    assert_eq!(rig.state()["time"].as_f64(), Some(last));
    rig.key(Key::ArrowRight);
    assert_eq!(rig.state()["time"].as_f64(), Some(last));
}

#[test]
fn a_flight_that_is_stopped_or_fails_ends_where_it_was_flown_to() {
    for is_stopped in [true, false] {
        let (mut rig, id, _) = half_flown();
        if is_stopped {
            rig.harness.get_by_label("Stop computing").click();
        } else {
            let failed = JobEvent::Failed("The filter broke.".to_owned());
            rig.host().events.push((id, failed));
        }
        rig.frames(3);
        assert_eq!(rig.state()["run_complete"], true);
        rig.key(Key::End);
        assert_eq!(rig.state()["time"].as_f64(), Some(HALF));
        // What is saved of it says so.
        for words in ["save the run", "save the flown track as csv"] {
            rig.key_with(Modifiers::COMMAND, Key::K);
            rig.harness.event(Event::Text(words.into()));
            rig.frames(2);
            rig.key(Key::Enter);
            rig.frames(3);
            let told = rig.state()["toasts"].to_string();
            assert!(told.contains("the first 30 s of 60 s"), "{words}: {told}");
        }
        // Play begins anew at the end, also where the replay does not repeat itself.
        rig.key(Key::L);
        rig.key(Key::End);
        rig.key(Key::Space);
        rig.frames(3);
        let state = rig.state();
        assert_eq!(state["playing"], true);
        assert!(state["time"].as_f64() < Some(5.0), "{}", state["time"]);
    }
}

#[test]
fn a_screen_reader_sets_the_time_and_steps_from_there() {
    let mut rig = rig();
    let most = (rig.harness.get_by_role_and_label(Role::Slider, "Time"))
        .accesskit_node()
        .max_numeric_value();
    assert_eq!(most, rig.state()["span"][1].as_f64());
    for (action, data, time) in [
        (Action::SetValue, Some(ActionData::NumericValue(2.0)), 2.0),
        (Action::Increment, None, 2.5),
        (Action::Decrement, None, 2.0),
    ] {
        let slider = rig.harness.get_by_role_and_label(Role::Slider, "Time");
        let request = ActionRequest {
            action,
            target_tree: TreeId::ROOT,
            target_node: slider.accesskit_node().locate().0,
            data,
        };
        rig.harness.event(Event::AccessKitActionRequest(request));
        rig.frames(2);
        assert_eq!(rig.state()["time"].as_f64(), Some(time), "{action:?}");
    }
}

#[test]
fn digits_set_the_speed() {
    let mut rig = rig();
    rig.key(Key::Num1);
    assert_eq!(rig.state()["speed"], 0.1);
    rig.key(Key::Num0);
    assert_eq!(rig.state()["speed"], 20.0);
}

/// Time of what a view drew last, if it drew it for the cursor as it stands.
fn shown(rig: &super::support::Rig, view: &str) -> f64 {
    let state = rig.state();
    let drawn = &state["drawn"][view];
    assert_eq!(drawn["cursor"], state["time"], "{view} lags behind");
    drawn["content"].as_f64().expect("something was drawn")
}

#[test]
fn every_view_draws_what_belongs_to_the_new_time() {
    let mut rig = rig();
    let track = rig.rect("/timeline");
    let at = |part: f32| Pos2::new(track.left() + part * track.width(), track.center().y);
    let mut before = [f64::NAN; 6];
    for part in [0.7, 0.3] {
        rig.drag(at(0.5), at(part));
        let mut now = Vec::new();
        for (tab, views) in [
            ("Match", ["map", "camera", "match"]),
            ("Filter", ["inspector", "plots", "timeline"]),
        ] {
            rig.open_tab(tab);
            now.extend(views.map(|view| shown(&rig, view)));
        }
        let time = rig.state()["time"].as_f64().expect("a time");
        for (index, content) in now.iter().enumerate() {
            assert!(
                *content <= time + 1e-6 && *content > time - 5.0,
                "{index}: {content}"
            );
            assert_ne!(*content, before[index], "{index} did not change");
        }
        before.copy_from_slice(&now);
    }
}
