use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use pilotage_core::navigator::RegistrationReport;
use pilotage_core::registration::RegistrationMethod;

use super::super::fixture::Fixture;
use super::super::shown::{Shown, shown};
use super::*;
use crate::command::Command;

fn harness(time: f64) -> Harness<'static, Shown<InspectorView>> {
    shown([360.0, 1200.0], time, InspectorView::show)
}

#[test]
fn a_corrected_step_shows_its_sentence_gain_and_landmarks() {
    let fixture = Fixture::lasting(20.0);
    let step = fixture.run.steps.iter().find(|s| s.corrected()).unwrap();
    let mut harness = harness(step.time);
    harness.run();
    harness.get_by_label_contains("from where expected");
    harness.get_by_label("Kalman gain of Church");
    harness.get_by_label("Covariance of the state");
    harness.get_by_label("Church, accepted").click();
    harness.run();
    assert!(
        harness
            .state()
            .commands
            .contains(&Command::SelectLandmark(Some(1)))
    );
}

#[test]
fn the_probability_of_a_whole_picture_is_never_rounded_to_certainty() {
    let mut harness = harness(12.0);
    let steps = &mut harness.state_mut().fixture.run.steps;
    for frame in steps.iter_mut().filter_map(|step| step.frame.as_mut()) {
        frame.laid = Some(RegistrationReport {
            place: None,
            refusal: None,
            refused_as: None,
            tried: 60,
            laid_by: RegistrationMethod::WholeFrame,
            log_false_alarms: -4.0,
            probability: Some(0.9997),
        });
    }
    harness.run();
    harness.get_by_label_contains("likeliest place > 99.9 %");
}

#[test]
fn the_step_at_the_cursor_can_be_shown_instead_of_the_last_picture() {
    let mut harness = harness(12.2);
    harness.run();
    harness.get_by_label_contains("at 0:12.0");
    harness.get_by_label("This very step").click();
    harness.run();
    harness.get_by_label_contains("at 0:12.2");
}

#[test]
fn before_the_first_step_the_view_says_so() {
    let mut harness = harness(-1.0);
    harness.run();
    harness.get_by_label("No step yet");
}
