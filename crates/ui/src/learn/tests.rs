use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use super::command::LearnCommand;
use super::tour::Tour;
use crate::command::Command;
use crate::context::ViewContext;
use crate::units::Units;
use crate::views::fixture::Fixture;

struct State {
    fixture: Fixture,
    tour: Tour,
    playing: bool,
    clock_zero: f64,
    units: Units,
    commands: Vec<Command>,
}

fn harness() -> Harness<'static, State> {
    harness_while(false)
}

fn harness_while(playing: bool) -> Harness<'static, State> {
    harness_over(Fixture::new(), playing, 0.0)
}

fn harness_over(fixture: Fixture, playing: bool, clock_zero: f64) -> Harness<'static, State> {
    let state = State {
        fixture,
        tour: Tour::default(),
        playing,
        clock_zero,
        units: Units::Metric,
        commands: Vec::new(),
    };
    Harness::builder().with_size([360.0, 460.0]).build_ui_state(
        |ui, state| {
            let fixture = &state.fixture;
            let mut context = ViewContext {
                playing: state.playing,
                clock_zero: state.clock_zero,
                units: state.units,
                ..fixture.context(state.clock_zero + 5.0, &mut state.commands)
            };
            state.tour.show(ui, &mut context);
        },
        state,
    )
}

#[test]
fn next_leads_through_all_stops_each_seeking_to_its_own_moment() {
    let mut harness = harness();
    let stops = harness.state().tour.stops();
    for number in 0..stops {
        harness.run();
        let title = harness.state().tour.title();
        harness.get_by_label(title);
        let seeks = harness
            .state()
            .commands
            .iter()
            .filter(|c| matches!(c, Command::SeekTo(_)))
            .count();
        assert_eq!(seeks, number + 1, "at {title}");
        harness.get_by_label_contains("Try: ");
        let button = if number + 1 == stops {
            "Finish"
        } else {
            "Next"
        };
        harness.get_by_label(button).click();
    }
    harness.run();
    let leave = Command::from(LearnCommand::Toggle);
    assert!(harness.state().commands.contains(&leave));
}

#[test]
fn arriving_at_a_stop_pauses_the_flight() {
    let harness = harness_while(true);
    let commands = &harness.state().commands;
    let pauses = commands
        .iter()
        .filter(|c| **c == Command::TogglePlay)
        .count();
    assert_eq!(pauses, 1);
}

#[test]
fn trying_another_gate_changes_the_settings_and_can_be_taken_back() {
    let mut harness = harness();
    harness.run();
    harness.get_by_label_contains("The gate: how far").click();
    harness.run();
    harness
        .get_by_label_contains("Try: Fly again with a gate")
        .click();
    harness.run();
    let changed = harness.state().commands.iter().any(|c| match c {
        Command::SetNavigator(settings) => settings.gate_confidence == 0.80,
        _ => false,
    });
    assert!(changed);
    harness.get_by_label("Take it back").click();
    harness.run();
    assert!(harness.state().commands.contains(&Command::Undo));
}

#[test]
fn arrow_keys_turn_the_pages_while_a_button_of_the_tour_has_the_focus() {
    let mut harness = harness();
    harness.run();
    harness.get_by_label("Next").focus();
    harness.run();
    harness.key_press(egui::Key::ArrowRight);
    harness.run();
    assert_eq!(harness.state().tour.number(), 1);
    harness.key_press(egui::Key::ArrowLeft);
    harness.run();
    assert_eq!(harness.state().tour.number(), 0);
}

#[test]
fn a_run_is_looked_through_once_for_each_stop_and_told_anew_in_other_units() {
    let mut harness = harness();
    let stops = harness.state().tour.stops();
    for number in 0..stops {
        harness.state_mut().tour.go_to(number);
        harness.run();
        harness.run_steps(6);
    }
    let looked_up = harness.state().tour.looked_up;
    // Once for the stop that was open at first.
    assert!(looked_up <= stops + 1, "{looked_up}");
    harness.state_mut().units = Units::Aviation;
    harness.run();
    assert_eq!(harness.state().tour.looked_up, looked_up + 1);
    // Another run of as many steps.
    let steps = &mut harness.state_mut().fixture.run.steps;
    let last = steps.last_mut().unwrap();
    last.after.mean[0] += 1.0;
    harness.run();
    assert_eq!(harness.state().tour.looked_up, looked_up + 2);
}

/// Words that are painted.
fn painted(harness: &Harness<'_, State>) -> Vec<String> {
    let shapes = harness.output().shapes.iter();
    let texts = shapes.filter_map(|drawn| match &drawn.shape {
        egui::Shape::Text(text) => Some(text.galley.text().to_owned()),
        _ => None,
    });
    texts.collect()
}

#[test]
fn figures_say_how_large_they_are_and_what_is_asked_of_a_match() {
    let mut harness = harness();
    harness.run();
    harness.get_by_label("Next").click();
    harness.run();
    let words = painted(&harness);
    assert!(
        words.iter().any(|it| it == "before the picture"),
        "{words:?}"
    );
    assert!(words.iter().any(|it| is_length(it)), "{words:?}");
    for _ in 0..2 {
        harness.get_by_label("Next").click();
        harness.run();
    }
    let words = painted(&harness);
    for asked in ["runner-up / best", "at most 0.85", "surprise (NIS)"] {
        assert!(words.iter().any(|it| it == asked), "{asked} in {words:?}");
    }
}

/// Whether these words are a round length.
fn is_length(words: &str) -> bool {
    let number = words.strip_suffix(" m");
    number.is_some_and(|number| number.parse::<f64>().is_ok())
}

#[test]
fn the_gate_is_as_large_as_its_ellipse_and_not_as_what_was_found_beyond_it() {
    let mut fixture = Fixture::new();
    let steps = fixture.run.steps.iter_mut();
    let mut frames = steps.filter_map(|step| step.frame.as_mut());
    let frame = frames.find(|it| it.accepted().count() > 0).unwrap();
    for candidate in &mut frame.candidates {
        // Axes of 3 and 2 px at 1σ, and a gate at 4σ.
        candidate.innovation_covariance = nalgebra::Matrix2::new(4.0, 0.0, 0.0, 9.0);
        candidate.threshold = 16.0;
        candidate.innovation = Some(nalgebra::Vector2::new(0.0, 20.0));
    }
    let words = painted_at("first-landmark", fixture, 0.0);
    assert!(
        words.iter().any(|it| it == "gate: up to 12.0 px"),
        "{words:?}"
    );
}

/// Words that the stop of a link paints over a run.
fn painted_at(stop: &str, fixture: Fixture, clock_zero: f64) -> Vec<String> {
    let mut harness = harness_over(fixture, false, clock_zero);
    let number = super::lessons::linked(stop).unwrap();
    harness.state_mut().tour.go_to(number);
    harness.run();
    painted(&harness)
}

#[test]
fn figures_over_time_go_by_the_clock_of_the_page() {
    for stop in ["dead-reckoning", "wind"] {
        let mut late = Fixture::new();
        let states = late.flight.truth.iter_mut().flat_map(|it| &mut it.states);
        let times = states.map(|state| &mut state.time);
        let steps = late.run.steps.iter_mut().map(|step| &mut step.time);
        for time in times.chain(steps) {
            *time += 1024.0;
        }
        let expected = painted_at(stop, Fixture::new(), 0.0);
        assert!(expected.iter().any(|it| it == "time, s"), "{expected:?}");
        assert_eq!(painted_at(stop, late, 1024.0), expected);
    }
}
