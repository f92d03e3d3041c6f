//! A span of time is selected in the timeline, in a plot, by keys, and let go of again.

use egui::{Key, Modifiers, Pos2, Rect};
use egui_kittest::kittest::Queryable as _;

use super::support::{Rig, rig};

/// Selected span, as shares of the flight.
fn selected(rig: &Rig) -> Option<(f64, f64)> {
    let state = rig.state();
    let span = [0, 1].map(|i| state["span"][i].as_f64().expect("a span"));
    let share = |i: usize| Some((state["selected"][i].as_f64()? - span[0]) / (span[1] - span[0]));
    share(0).zip(share(1))
}

fn is_about(rig: &Rig, from: f64, to: f64) {
    let (a, b) = selected(rig).expect("something is selected");
    assert!((a - from).abs() < 0.01, "{a} is not {from}");
    assert!((b - to).abs() < 0.01, "{b} is not {to}");
}

fn at(rect: Rect, part: f32) -> Pos2 {
    Pos2::new(rect.left() + part * rect.width(), rect.center().y)
}

#[test]
fn a_drag_with_shift_on_the_timeline_selects_and_leaves_the_cursor_alone() {
    let mut rig = rig();
    let track = rig.rect("/timeline");
    let before = rig.state()["time"].clone();
    rig.drag_with(Modifiers::SHIFT, at(track, 0.6), at(track, 0.3));
    is_about(&rig, 0.3, 0.6);
    assert_eq!(rig.state()["time"], before);
}

#[test]
fn an_edge_of_the_selected_span_is_dragged_in_the_timeline() {
    let mut rig = rig();
    let track = rig.rect("/timeline");
    rig.drag_with(Modifiers::SHIFT, at(track, 0.3), at(track, 0.6));
    rig.drag(at(track, 0.6), at(track, 0.8));
    is_about(&rig, 0.3, 0.8);
    rig.drag(at(track, 0.3), at(track, 0.9));
    is_about(&rig, 0.8, 0.9);
}

#[test]
fn a_drag_with_shift_on_a_plot_of_the_run_selects() {
    let mut rig = rig();
    let plot = rig.harness.get_by_label("Distance from truth plot").rect();
    rig.drag_with(Modifiers::SHIFT, at(plot, 0.4), at(plot, 0.7));
    let (from, to) = selected(&rig).expect("something is selected");
    assert!(to - from > 0.25 && to - from < 0.4, "{from} to {to}");
}

#[test]
fn escape_lets_go_of_the_selected_span() {
    let mut rig = rig();
    let track = rig.rect("/timeline");
    rig.drag_with(Modifiers::SHIFT, at(track, 0.3), at(track, 0.6));
    rig.key(Key::Escape);
    assert_eq!(selected(&rig), None);
}

#[test]
fn a_span_is_selected_by_keys_from_the_cursor_to_the_cursor() {
    let mut rig = rig();
    rig.key(Key::Home);
    rig.key_with(Modifiers::SHIFT, Key::ArrowRight);
    rig.key_with(Modifiers::SHIFT, Key::B);
    rig.key_with(Modifiers::SHIFT, Key::ArrowRight);
    rig.key_with(Modifiers::SHIFT, Key::ArrowRight);
    rig.key_with(Modifiers::SHIFT, Key::E);
    let state = rig.state();
    assert_eq!(state["selected"], serde_json::json!([5.0, 15.0]));
}

#[test]
fn plots_show_the_selected_span_alone() {
    let mut rig = rig();
    let track = rig.rect("/timeline");
    rig.drag_with(Modifiers::SHIFT, at(track, 0.3), at(track, 0.6));
    rig.harness.get_by_label("Selected time").click();
    rig.frames(3);
    rig.harness.get_by_label("All time");
    let plot = rig.harness.get_by_label("Distance from truth plot").rect();
    rig.drag_with(Modifiers::SHIFT, at(plot, 0.5), at(plot, 0.9));
    let (from, to) = selected(&rig).expect("something is selected");
    assert!(from > 0.4 && to < 0.6 && to - from < 0.15, "{from} to {to}");
}
