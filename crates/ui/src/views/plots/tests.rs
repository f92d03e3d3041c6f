use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use super::super::shown::{Shown, shown};
use super::*;
use crate::command::Command;

fn harness() -> Harness<'static, Shown<PlotsView>> {
    shown([480.0, 420.0], 5.0, PlotsView::show)
}

#[test]
fn a_click_in_the_middle_of_a_plot_seeks_to_the_middle_of_the_flight() {
    let mut harness = harness();
    harness.run();
    let outer = harness.get_by_label("Distance from truth plot").rect();
    let rect = TimeAxis::curves_rect(outer, &Tokens::dark());
    harness.hover_at(rect.center());
    harness.drag_at(rect.center());
    harness.drop_at(rect.center());
    harness.run();
    let sought = harness.state().commands.iter().find_map(|c| match c {
        Command::SeekTo(time) => Some(*time),
        _ => None,
    });
    let span = harness.state().fixture.flight.span();
    let run = harness.state().fixture.run.span().unwrap();
    let middle = 0.5 * (span.0.min(run.0) + span.1.max(run.1));
    assert!((sought.unwrap() - middle).abs() < 0.2, "{sought:?}");
}

#[test]
fn a_panel_that_is_switched_off_leaves_the_view() {
    let mut harness = harness();
    harness.run();
    harness.get_by_label("Distance from truth plot");
    harness.get_by_label("Show Distance from truth").click();
    harness.run();
    assert!(harness.query_by_label("Distance from truth plot").is_none());
}

#[test]
fn a_folded_panel_keeps_its_heading_only() {
    let mut harness = harness();
    harness.run();
    harness.get_by_label("Fold Position error").click();
    harness.run();
    harness.get_by_label("Fold Position error");
    assert!(harness.query_by_label("Position error plot").is_none());
}

#[test]
fn less_time_halves_what_is_shown_and_all_brings_it_back() {
    let mut harness = harness();
    harness.run();
    harness.get_by_label("Less time").click();
    harness.run();
    let zoom = harness.state().view.time_axis.zoom.unwrap();
    assert!((zoom.1 - zoom.0 - 10.0).abs() < 0.1);
    assert!(zoom.0 <= 5.0 && 5.0 <= zoom.1);
    harness.get_by_label("All time").click();
    harness.run();
    assert!(harness.state().view.time_axis.zoom.is_none());
}

#[test]
fn a_stretch_of_a_longer_flight_gives_way_to_all_of_this_one_and_the_wheel_moves_nothing() {
    let mut harness = harness();
    harness.run();
    harness.state_mut().view.time_axis.zoom = Some((40.0, 80.0));
    harness.run();
    let outer = harness.get_by_label("Distance from truth plot").rect();
    harness.hover_at(outer.center());
    harness.run();
    harness.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: egui::vec2(60.0, 0.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: egui::Modifiers::NONE,
    });
    harness.run();
    let state = harness.state();
    let whole = state.fixture.flight.span();
    let shown = state.view.time_axis.span((whole.0, 20.0));
    assert_eq!(shown, (whole.0, 20.0));
}

#[test]
fn two_plots_are_shown_at_first_and_their_choices_are_reached_without_a_pointer() {
    let mut harness = harness();
    harness.run();
    let plots = [
        "Position error plot",
        "Distance from truth plot",
        "Wind plot",
        "NIS plot",
    ];
    let shown = plots.map(|name| harness.query_by_label(name).is_some());
    assert_eq!(shown, [true, true, false, false]);
    harness.get_by_label("Position error, east").focus();
    harness.run();
    harness.key_press(egui::Key::Enter);
    harness.run();
    assert_eq!(harness.state().view.panels[0].choice, 1);
}
