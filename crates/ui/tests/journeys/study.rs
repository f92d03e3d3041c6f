//! A study is chosen and flown; a flight that failed is opened in Replay.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;
use pilotage_core::simulate::Scenario;
use pilotage_jobs::{FlightSource, Job, JobEvent, StudyFlightsOrder};
use pilotage_study::{MeasureKind, Study, StudyDesign, StudyPlan, StudyTally};
use serde_json::Value;

use super::plan::{draw, planning};
use super::support::real::Studies;
use super::support::{Rig, rig};

/// Few and short flights, of which those by dead reckoning alone fail.
const PLAN: &str = r#"
name = "short"
question = "What if nothing is recognised?"
seed = 4
draws = 10
fixed = { seconds = 10, step = 0.25, doubts = "no", wind-speed = 8, wind-from = 90 }
cross.recognised = [1, 0]
measure = [{ of = "error-rms" }, { of = "error-max", name = "within 12 m", at_most = 12 }]
"#;

fn study(rig: &Rig) -> Value {
    rig.state()["study"].clone()
}

/// The sheet of studies, opened from the menu.
fn opened() -> Rig {
    let mut rig = rig();
    rig.menu("Open", "Fly a study: many flights…");
    rig
}

/// The sheet with a plan typed in the place of the shipped one.
fn typed(text: &str) -> Rig {
    typed_in(opened(), text)
}

fn typed_in(mut rig: Rig, text: &str) -> Rig {
    rig.harness.get_by_label("The plan as text (TOML)").click();
    rig.frames(12);
    let field = rig.harness.get_by_label("Plan of the study");
    field.focus();
    rig.frames(2);
    rig.key_with(egui::Modifiers::COMMAND, Key::A);
    rig.harness
        .get_by_label("Plan of the study")
        .type_text(text);
    rig.frames(3);
    rig
}

/// The study flown to its end.
fn flown(text: &str) -> Rig {
    flown_in(typed(text))
}

fn flown_in(mut rig: Rig) -> Rig {
    rig.harness.get_by_label_contains("Fly 20 flights").click();
    for _ in 0..40 {
        rig.frames(2);
        if study(&rig)["study"]["flown"] == 20 {
            break;
        }
    }
    rig
}

fn orders(rig: &Rig) -> Vec<StudyFlightsOrder> {
    let jobs = rig.harness.state().host.jobs.iter();
    jobs.filter_map(|(_, job)| match job {
        Job::StudyFlights(order) => Some(order.clone()),
        _ => None,
    })
    .collect()
}

#[test]
fn a_plan_that_comes_with_the_program_is_chosen_and_says_how_many_flights_it_is() {
    let mut rig = opened();
    rig.harness.get_by_label_contains("change one thing");
    rig.harness.get_by_label("Fly 240 flights");
    let hostile = "What does a failing instrument cost, and does the ellipse still hold the truth?";
    rig.harness
        .get_by_role_and_label(Role::RadioButton, hostile)
        .click();
    rig.frames(3);
    assert_eq!(
        (&study(&rig)["chosen"], &study(&rig)["flights"]),
        (&1.into(), &280.into())
    );
    rig.harness.get_by_label("Fly 280 flights");
    rig.harness.get_by_label("Save plan").click();
    rig.frames(2);
    let (name, text) = rig
        .harness
        .state()
        .host
        .saved
        .last()
        .cloned()
        .expect("a file");
    let plan = StudyPlan::read(std::str::from_utf8(&text).expect("text")).expect("a plan");
    assert_eq!((name.as_str(), plan.runs()), ("hostile.toml", 280));
}

#[test]
fn who_simulates_a_flight_is_offered_many() {
    let mut rig = rig();
    rig.menu("Open", "Simulate a flight…");
    rig.frames(8);
    rig.harness.get_by_label("A study: many flights…").click();
    rig.frames(4);
    assert_eq!(rig.state()["side_tab"], "study");
    rig.harness.get_by_label("Close").click();
    rig.frames(3);
    assert_ne!(rig.state()["side_tab"], "study");
}

#[test]
fn a_plan_that_makes_no_sense_is_refused_with_its_place_and_nothing_is_flown() {
    let rig = typed(&PLAN.replace("recognised = [1, 0]", "recognized = [1, 0]"));
    rig.harness
        .get_by_label_contains("cross.recognized: there is no such setting");
    assert!(study(&rig)["flights"].is_null());
    let large = typed(&PLAN.replace("draws = 10", "draws = 2000"));
    large
        .harness
        .get_by_label_contains("the page flies up to 2000");
    large
        .harness
        .get_by_label_contains("plan and fly it on the terminal: pilotage study short.toml");
}

#[test]
fn a_study_whose_plan_says_when_it_is_enough_ends_there_as_on_the_terminal() {
    let rule = "stop = { measure = \"error-rms\", half_width = 1000, every = 3 }";
    let text = format!("{PLAN}{rule}\n");
    let mut rig = typed(&text);
    rig.harness.get_by_label_contains(
        "once the 95 % interval of \"error-rms\" is no wider than 2000 m; looked at every 3 draws",
    );
    rig.harness.get_by_label_contains("Fly 20 flights").click();
    for _ in 0..40 {
        rig.frames(2);
        if study(&rig)["study"]["under_way"] == false {
            break;
        }
    }
    let plan = StudyPlan::read(&text).expect("a plan");
    let design = StudyDesign::new(plan.clone());
    let mut tally = StudyTally::new(&design);
    let whole = Study::new(plan).expect("a study");
    for run in 0..20 {
        tally
            .take(whole.fly(run).expect("a row"))
            .expect("the next");
    }
    let terminal = tally.summary();
    assert!(terminal.is_stopped && terminal.draws < 10);
    let told = &study(&rig)["study"];
    assert_eq!(told["enough_after"], terminal.draws);
    assert_eq!(told["flown"], terminal.flights);
    rig.harness
        .get_by_label_contains("by the plan's rule to stop");
}

#[test]
fn the_flights_of_a_study_are_shared_out_in_small_pieces_and_told_as_they_come() {
    let rig = flown(PLAN);
    let orders = orders(&rig);
    let design = Study::new(StudyPlan::read(PLAN).expect("a plan")).expect("a study");
    let ordered: Vec<_> = orders
        .iter()
        .flat_map(|order| order.flights.clone())
        .collect();
    let runs = (0..20).map(|run| design.design().run(run).expect("a run").flight());
    assert_eq!(ordered, runs.collect::<Vec<_>>());
    assert!(orders.len() == 5 && orders.iter().all(|order| order.flights.len() == 4));
    let shares: Vec<usize> = orders.iter().map(|order| order.share % 3).collect();
    assert!(
        [0, 1, 2].iter().all(|share| shares.contains(share)),
        "{shares:?}"
    );
    let told = &study(&rig)["study"];
    assert_eq!(
        (&told["under_way"], &told["trouble"]),
        (&false.into(), &Value::Null)
    );
    let settings = told["settings"].as_array().expect("settings");
    assert_eq!(settings.len(), 2);
    let median = |at: usize| settings[at]["quantiles"][2].as_f64().expect("a median");
    assert!(median(0) < median(1), "{settings:?}");
    // Both plots say it in words.
    rig.harness.get_by_label_contains("1: median");
    rig.harness.get_by_label_contains("0: median");
    let inside: Vec<_> = rig
        .harness
        .get_all_by_label_contains("at the end the truth is inside")
        .collect();
    assert_eq!(inside.len(), 2);
}

#[test]
fn a_failed_flight_that_is_chosen_is_flown_again_to_the_bit_and_shown_in_replay() {
    let mut rig = flown(PLAN);
    let told = study(&rig)["study"].clone();
    let failed = told["failed"].as_array().expect("flights");
    assert!(!failed.is_empty() && failed.len() < 20, "{failed:?}");
    let largest = |run: &Value| run["largest"].as_f64().unwrap_or(f64::INFINITY);
    let worst = failed
        .iter()
        .max_by(|a, b| largest(a).total_cmp(&largest(b)))
        .expect("one")
        .clone();
    let run = worst["run"].as_u64().expect("a number");
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
    let FlightSource::Studied(studied) = &order.flight else {
        panic!("{:?}", order.flight);
    };
    assert_eq!(
        (studied.run, studied.study.as_str(), &order.mission),
        (run, "short", &None)
    );
    let state = rig.state();
    assert_eq!(state["workspace"], "Replay");
    assert_eq!(state["study"]["study"]["open"], run);
    assert_eq!(state["title"], format!("Run {run} of the study “short”"));
    assert_eq!(state["run_complete"], true);
    rig.harness
        .get_by_label_contains("It has no camera pictures");
    // It is the flight of the row.
    let scenario = Scenario::named(&studied.flight.settings.scenario).expect("a scenario");
    let numbers = studied.flight.numbers(&scenario.mission().landmarks);
    for (kind, key) in [
        (MeasureKind::ErrorMax, "largest"),
        (MeasureKind::Inside, "inside"),
    ] {
        assert_eq!(kind.among(&numbers), worst[key].as_f64(), "{key}");
    }
    // What the study found is still there, and another flight closes the run, not the study.
    rig.menu("Open", "Simulate a flight…");
    rig.frames(8);
    rig.harness.get_by_label("Fly").click();
    rig.settle();
    let after = study(&rig)["study"].clone();
    assert!(after["open"].is_null() && after["flown"] == 20, "{after:?}");
}

#[test]
fn a_flight_of_a_scenario_leaves_ones_own_mission_one_undo_away_and_says_so() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, 0.0), (260.0, 0.0)]);
    rig.menu("Open", "Fly a study: many flights…");
    let mut rig = flown_in(typed_in(rig, PLAN));
    let route = |rig: &Rig| rig.state()["plan"]["routes"][0]["name"].clone();
    assert_eq!(route(&rig), "Route 1");
    let failed = study(&rig)["study"]["failed"].clone();
    let run = failed[0]["run"].as_u64().expect("a run");
    let button = format!("Run {run}, ");
    rig.harness.get_by_label_contains(&button).focus();
    rig.frames(3);
    rig.key(Key::Enter);
    rig.frames(3);
    rig.settle();
    assert_ne!(route(&rig), "Route 1");
    let said = rig.state()["toasts"].to_string();
    assert!(said.contains("Undo brings back yours"), "{said}");
    rig.key_with(egui::Modifiers::COMMAND, Key::Z);
    rig.settle();
    assert_eq!(route(&rig), "Route 1");
}

#[test]
fn a_study_is_stopped_and_keeps_what_was_flown() {
    let mut rig = typed(PLAN);
    rig.host().studies = Studies::Left;
    rig.harness.get_by_label_contains("Fly 20 flights").click();
    rig.frames(3);
    assert_eq!(study(&rig)["study"]["under_way"], true);
    rig.harness.get_by_label("Stop the study").click();
    rig.frames(3);
    assert_eq!(study(&rig)["study"]["under_way"], false);
    rig.harness
        .get_by_label_contains("Stopped after 0 of 20 flights");
    let (jobs, cancelled) = {
        let host = &rig.harness.state().host;
        (orders(&rig).len(), host.cancelled.len())
    };
    assert_eq!(jobs, cancelled);
    // A worker that cannot go on ends the study with its reason.
    rig.harness.get_by_label("Another study…").click();
    rig.frames(3);
    rig.harness.get_by_label_contains("Fly 20 flights").click();
    rig.frames(3);
    let host = &mut rig.harness.state_mut().host;
    let (id, _) = host.jobs.last().cloned().expect("a job");
    host.events
        .push((id, JobEvent::Failed("out of memory.".to_owned())));
    rig.frames(3);
    assert_eq!(study(&rig)["study"]["trouble"], "out of memory.");
    rig.harness
        .get_by_label_contains("The study stopped: out of memory.");
}
