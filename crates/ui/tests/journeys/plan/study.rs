use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::{FlightSource, Job};
use pilotage_study::StudyPlan;

use super::{draw, planning};
use crate::support::Rig;

/// The question about the route that was drawn, chosen.
fn asked() -> Rig {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, 0.0), (260.0, 0.0)]);
    rig.menu("Open", "Fly a study: many flights…");
    let question = "How well is the place known along my route, in any wind up to 8 m/s?";
    rig.harness
        .get_by_role_and_label(Role::RadioButton, question)
        .click();
    rig.frames(6);
    rig
}

/// Text of the plan as it is saved for the terminal.
fn saved(rig: &mut Rig) -> String {
    rig.harness.get_by_label("Save plan").click();
    rig.frames(2);
    let saved = rig.harness.state().host.saved.last().cloned();
    let (name, text) = saved.expect("a file");
    assert_eq!(name, "routes.toml");
    String::from_utf8(text).expect("text")
}

fn fly(rig: &mut Rig, flights: u64) {
    let label = format!("Fly {flights} flights");
    rig.harness.get_by_label_contains(&label).click();
    for _ in 0..60 {
        rig.frames(2);
        if rig.state()["study"]["study"]["flown"] == flights {
            return;
        }
    }
    panic!("{}", rig.state()["study"]);
}

#[test]
fn a_route_that_was_drawn_is_studied_and_the_saved_plan_flies_the_same_on_the_terminal() {
    let mut rig = asked();
    assert_eq!(rig.state()["study"]["flights"], 40);
    // Its camera is that of the open flight, as in the prediction of the route.
    let said = rig.harness.query_by_label_contains("states no camera");
    assert!(said.is_none());
    let text = saved(&mut rig);
    let terminal = StudyPlan::read(&text).expect("a plan with its mission in it");
    assert_eq!(terminal.runs(), 40);
    fly(&mut rig, 40);
    let told = rig.state()["study"]["study"].clone();
    assert_eq!(told["trouble"], serde_json::Value::Null);
    let study = pilotage_study::Study::new(terminal).expect("a study");
    let mut largest: Vec<f64> = (0..40)
        .map(|run| study.fly(run).expect("a row").measured[0].expect("an error"))
        .collect();
    largest.sort_by(f64::total_cmp);
    let median = told["settings"][0]["quantiles"][2]
        .as_f64()
        .expect("a median");
    let between = largest[19]..=largest[20];
    assert!(between.contains(&median), "{median} {between:?}");
    // A change of the mission is a change of the plan.
    rig.key_with(egui::Modifiers::COMMAND, Key::Z);
    rig.frames(6);
    assert!(rig.state()["study"]["flights"].is_null());
}

#[test]
fn a_failed_flight_of_a_route_is_watched_with_the_mission_that_is_open_left_as_it_is() {
    let mut rig = asked();
    let text = saved(&mut rig);
    let (plan, _) = text.split_once("\n[missions]").expect("missions");
    let harder = plan
        .replace("at_most = 20", "at_most = 0.001")
        .replace("draws = 40", "draws = 10");
    rig.harness.get_by_label("The plan as text (TOML)").click();
    rig.frames(12);
    rig.harness.get_by_label("Plan of the study").focus();
    rig.frames(2);
    rig.key_with(egui::Modifiers::COMMAND, Key::A);
    rig.harness
        .get_by_label("Plan of the study")
        .type_text(&harder);
    rig.frames(6);
    // So that the button below it is on screen.
    rig.harness.get_by_label("The plan as text (TOML)").click();
    rig.frames(12);
    fly(&mut rig, 10);
    let mission = rig.state()["mission"].clone();
    let failed = rig.state()["study"]["study"]["failed"].clone();
    let worst = &failed[0];
    let run = worst["run"].as_u64().expect("a run");
    rig.harness
        .get_by_label_contains(&format!("Run {run}, "))
        .focus();
    rig.frames(3);
    rig.key(Key::Enter);
    rig.frames(3);
    rig.settle();
    let Some((_, Job::Fly(order))) = rig.harness.state().host.last_flight().cloned() else {
        panic!("no flight");
    };
    assert!(matches!(&order.flight, FlightSource::Studied(it) if it.flight.mission.is_some()));
    let state = rig.state();
    assert_eq!(
        (&state["workspace"], &state["run_complete"]),
        (&"Replay".into(), &true.into())
    );
    assert_eq!(state["mission"], mission);
    assert_eq!(state["study"]["study"]["open"], run);
    // Its undo steps are still there, too.
    rig.key_with(egui::Modifiers::COMMAND, Key::Z);
    rig.settle();
    let left = &rig.state()["plan"]["routes"][0]["way_points"];
    assert_eq!(left.as_array().map(Vec::len), Some(1));
}
