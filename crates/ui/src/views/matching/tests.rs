use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use super::super::fixture::{Fixture, match_pictures};
use super::*;
use crate::tokens::Tokens;
use crate::units::Units;

struct State {
    fixture: Fixture,
    view: MatchView,
    pictures: Option<MatchPictures>,
    time: f64,
    commands: Vec<Command>,
}

fn harness(time: f64) -> Harness<'static, State> {
    let state = State {
        fixture: Fixture::lasting(20.0),
        view: MatchView::default(),
        pictures: None,
        time,
        commands: Vec::new(),
    };
    Harness::builder().with_size([420.0, 560.0]).build_ui_state(
        |ui, state| {
            let fixture = &state.fixture;
            let mut context = ViewContext {
                mission: &fixture.mission,
                flight: Some(&fixture.flight),
                run: Some(&fixture.run),
                ghost: None,
                time: state.time,
                playing: false,
                selection: None,
                pictures: &|_| None,
                match_pictures: state.pictures.as_ref(),
                tokens: &Tokens::dark(),
                units: Units::Metric,
                commands: &mut state.commands,
            };
            state.view.show(ui, &mut context);
        },
        state,
    )
}

#[test]
fn the_numbers_stand_before_the_pictures_arrive_and_the_pictures_are_asked_for() {
    let mut harness = harness(12.0);
    harness.run();
    harness.get_by_label_contains("Score");
    harness.get_by_label("The pictures of this match are on their way");
    let (time, landmark) = harness.state().view.wanted().unwrap();
    assert!(
        harness
            .state()
            .commands
            .contains(&Command::ExplainMatch { time, landmark })
    );
}

#[test]
fn pictures_of_another_match_are_not_shown() {
    let mut harness = harness(12.0);
    harness.run();
    let (time, landmark) = harness.state().view.wanted().unwrap();
    let other = match_pictures(time - 1.0, landmark);
    harness.state_mut().pictures = Some(other);
    harness.run();
    harness.get_by_label("The pictures of this match are on their way");
    let right = match_pictures(time, landmark);
    harness.state_mut().pictures = Some(right);
    harness.run();
    harness.get_by_label("Map patch, rectified picture, and score at every place");
}
