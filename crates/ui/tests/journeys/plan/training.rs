use egui::Vec2;
use egui_kittest::kittest::Queryable as _;
use pilotage_core::landmark::cascade::train::StageRow;
use pilotage_core::training::{StageReport, TrainingPhase};
use pilotage_jobs::{
    FlyOrder, Job, JobEvent, JobId, TrainOrder, TrainingLeft, TrainingOutcome, TrainingReport,
};
use serde_json::Value;

use super::super::support::{Rig, ScriptedHost, rig_on};
use super::planning;

/// The trainings that were asked for.
fn asked(rig: &mut Rig) -> Vec<(JobId, TrainOrder)> {
    let jobs = rig.host().jobs.iter();
    let trainings = jobs.filter_map(|(id, job)| match job {
        Job::Train(order) => Some((*id, order.as_ref().clone())),
        _ => None,
    });
    trainings.collect()
}

fn say(rig: &mut Rig, id: JobId, event: JobEvent) {
    rig.host().events.push((id, event));
    rig.settle();
}

fn row(votes: usize) -> StageRow {
    StageRow {
        votes,
        hit_rate: 0.996,
        false_alarm_rate: 0.37,
        positives: 440,
        negatives: 1200,
    }
}

fn stages(count: usize) -> Vec<StageReport> {
    let stage = |number: usize| StageReport {
        row: row(7 * (number + 1)),
        passed_before: 0.37_f64.powi(number as i32),
    };
    (0..count).map(stage).collect()
}

/// A word on a training with so many whole stages, of which the last has just become whole.
fn report(whole: usize) -> JobEvent {
    JobEvent::Training(Box::new(TrainingReport {
        fraction: 0.5,
        phase: TrainingPhase::Voting,
        stages: stages(whole),
        growing: Some(row(3)),
        seconds: 21.4,
        left: (whole > 0).then(|| TrainingLeft {
            progress: vec![1, 2, 3],
            stages: stages(whole),
            seconds: 20.0,
        }),
    }))
}

fn outcome(order: &TrainOrder) -> JobEvent {
    let b = order.landmark.bounds;
    let detector = format!(
        r#"{{"bounds":{{"east":{},"north":{},"south":{},"west":{}}}}}"#,
        b.east, b.north, b.south, b.west
    );
    JobEvent::Trained(Box::new(TrainingOutcome {
        detector,
        stages: stages(4),
        judged: 100,
        found: 99,
        false_alarms: 1,
        least_score: 3.417,
        sigmas: [0.21, 0.25],
        seconds: 41.0,
    }))
}

fn trainings(rig: &Rig) -> Vec<Value> {
    let state = rig.state();
    state["plan"]["trainings"]
        .as_array()
        .cloned()
        .unwrap_or_default()
}

/// The Chapel selected, its detector being trained.
fn training() -> (Rig, JobId, TrainOrder) {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label_contains("Chapel: ").click();
    rig.settle();
    rig.harness.get_by_label("Train detector").click();
    rig.settle();
    let (id, order) = asked(&mut rig).pop().expect("a training");
    (rig, id, order)
}

#[test]
fn the_stage_table_grows_while_a_detector_is_trained_and_the_flight_flies_with_it() {
    let (mut rig, id, order) = training();
    assert_eq!(order.landmark.name, "Chapel");
    assert_eq!((order.plan.photos, order.plan.held_out), (110, 100));
    let within = order.look_alikes_within;
    assert!(within >= 30.0, "look-alikes are sought within {within} m");
    say(&mut rig, id, report(2));
    rig.harness.get_by_label(
        "Stage 1: 7 features, 99.6\u{a0}% hits, 37.0\u{a0}% false alarms, 100\u{a0}% looked at",
    );
    rig.harness.get_by_label(
        "Stage 2: 14 features, 99.6\u{a0}% hits, 37.0\u{a0}% false alarms, 37.0\u{a0}% looked at",
    );
    rig.harness
        .get_by_label("Stage 3: 3 features, 99.6\u{a0}% hits, 37.0\u{a0}% false alarms, growing");
    assert_eq!(trainings(&rig)[0]["state"], "Working");

    let flights = rig.host().flights();
    say(&mut rig, id, outcome(&order));
    say(&mut rig, id, JobEvent::Finished);
    rig.harness.get_by_label_contains(
        "Found in 99 of 100 photos that it did not learn from (99\u{a0}%), 1 false alarm. It counts as found where its \
         score is 3.42 or more",
    );
    let unused = "Flights do not use it yet";
    rig.harness.get_by_label_contains(unused);
    let undo = rig.state()["undo"].as_u64();
    rig.harness
        .get_by_role_and_label(egui::accesskit::Role::Tab, "Cascade")
        .click();
    rig.settle();
    assert!(rig.harness.query_by_label_contains(unused).is_none());
    assert_eq!(rig.state()["undo"].as_u64(), undo.map(|u| u + 1));
    rig.open_tab("Replay");
    rig.settle();
    assert_eq!(
        rig.host().flights(),
        flights + 1,
        "the flight flies with it"
    );
    let Some((_, Job::Fly(FlyOrder { mission, .. }))) = rig.host().last_flight().cloned() else {
        panic!("no flight");
    };
    let mission = mission.expect("the mission as it is now");
    let chapel = mission.landmark(order.landmark.id).expect("the landmark");
    assert!(chapel.is_trained());
    assert_eq!(chapel.detector_choice().key(), "cascade");
}

#[test]
fn a_measurement_is_of_no_use_once_another_detector_looks() {
    let (mut rig, id, order) = training();
    let measure = "Test how well it is found";
    rig.harness.get_by_label(measure).click();
    rig.settle();
    let measured = |rig: &Rig| rig.state()["plan"]["measured"].as_array().map(Vec::len);
    assert_eq!(measured(&rig), Some(1));
    say(&mut rig, id, outcome(&order));
    assert_eq!(
        measured(&rig),
        Some(1),
        "it is still looked for by its map patch"
    );
    rig.harness
        .get_by_role_and_label(egui::accesskit::Role::Tab, "Both")
        .click();
    rig.frames(4);
    assert_eq!(measured(&rig), Some(0));
    rig.settle();
    assert_eq!(measured(&rig), Some(1), "it is measured by itself");
}

#[test]
fn a_training_is_paused_resumed_and_cancelled() {
    let (mut rig, id, _) = training();
    say(&mut rig, id, report(1));
    let click = |rig: &mut Rig, label: &str| {
        rig.harness.get_by_label(label).click();
        rig.settle();
    };
    click(&mut rig, "Pause the training of Chapel");
    assert_eq!(rig.host().held, [(id, true)]);
    assert!(super::count(&rig, "Paused at stage 2") > 0);
    click(&mut rig, "Resume the training of Chapel");
    assert_eq!(rig.host().held, [(id, true), (id, false)]);
    assert_eq!(trainings(&rig)[0]["state"], "Working");
    click(&mut rig, "Cancel the training of Chapel");
    assert_eq!(rig.host().cancelled.last(), Some(&id));
    assert!(trainings(&rig).is_empty());
    rig.harness.get_by_label("Train detector");
}

#[test]
fn a_training_goes_on_after_a_reload_behind_its_last_whole_stage() {
    let (mut rig, id, order) = training();
    say(&mut rig, id, report(2));
    let host = ScriptedHost {
        stored: rig.host().stored.clone(),
        ..ScriptedHost::default()
    };
    let mut again = rig_on(host, Vec2::new(1440.0, 900.0));
    assert!(
        again.state()["toasts"]
            .to_string()
            .contains("The training of Chapel was left")
    );
    again.open_tab("Plan");
    again.settle();
    again.open_tab("Landmarks");
    assert!(asked(&mut again).is_empty(), "nobody asked for it");
    again.harness.get_by_label("Paused at stage 3");
    again
        .harness
        .get_by_label("Resume the training of Chapel")
        .click();
    again.settle();
    let (_, resumed) = asked(&mut again).pop().expect("a training");
    let left = resumed.left.clone().expect("where it was left");
    assert_eq!((left.progress, left.stages.len()), (vec![1, 2, 3], 2));
    assert_eq!(
        TrainOrder {
            left: None,
            ..resumed
        },
        order,
        "else as it was"
    );
}

#[test]
fn all_landmarks_are_trained_two_at_a_time_and_wait_for_their_turn() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Train all").click();
    rig.settle();
    let first = asked(&mut rig);
    assert_eq!(first.len(), 2);
    let states = |rig: &Rig| -> Vec<String> {
        let all = trainings(rig).into_iter();
        all.map(|t| t["state"].as_str().unwrap_or_default().to_owned())
            .collect()
    };
    assert_eq!(states(&rig), ["Working", "Working", "Waiting", "Waiting"]);
    // One that is paused makes room, one that is over, too.
    let (id, order) = first[0].clone();
    let name = order.landmark.name.clone();
    rig.harness
        .get_by_label(&format!("Pause the training of {name}"))
        .click();
    rig.settle();
    assert_eq!(states(&rig), ["Paused", "Working", "Working", "Waiting"]);
    let (second, order) = first[1].clone();
    say(&mut rig, second, outcome(&order));
    say(&mut rig, second, JobEvent::Finished);
    assert_eq!(states(&rig), ["Paused", "Done", "Working", "Working"]);
    rig.harness.get_by_label("Cancel all trainings").click();
    rig.settle();
    assert_eq!(states(&rig), ["Done"]);
    assert!(rig.host().cancelled.contains(&id));
}

#[test]
fn a_detector_is_chosen_for_all_marked_landmarks_in_one_step() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Mark all").click();
    rig.settle();
    rig.harness
        .get_by_role_and_label(egui::accesskit::Role::Tab, "Cascade")
        .click();
    rig.settle();
    let choices = |rig: &Rig| -> Vec<Value> {
        let state = rig.state();
        let all = state["landmarks"].as_array().cloned().unwrap_or_default();
        all.iter().map(|l| l["detector"].clone()).collect()
    };
    assert_eq!(choices(&rig), ["cascade"; 4]);
    rig.harness
        .get_by_label("Not trained yet: until then it is looked for by its map patch.");
    rig.harness.get_by_label("Train 4 detectors").click();
    rig.settle();
    assert_eq!(trainings(&rig).len(), 4);
    rig.key_with(egui::Modifiers::COMMAND, egui::Key::Z);
    assert_eq!(choices(&rig), ["template"; 4]);
}
