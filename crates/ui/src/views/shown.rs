//! A view on the screen of a test, over the flight that the tests of views share.

use egui::Ui;
use egui_kittest::Harness;

use super::fixture::Fixture;
use crate::command::Command;
use crate::context::ViewContext;

/// A view, its flight of twenty seconds, the time cursor in seconds, and the commands that it sent.
pub(super) struct Shown<V> {
    pub fixture: Fixture,
    pub view: V,
    pub time: f64,
    pub commands: Vec<Command>,
}

/// The view that `draw` draws, on a screen of `size` points, at a time.
pub(super) fn shown<V: Default + 'static>(
    size: [f32; 2],
    time: f64,
    draw: impl Fn(&mut V, &mut Ui, &mut ViewContext<'_>) + 'static,
) -> Harness<'static, Shown<V>> {
    let state = Shown {
        fixture: Fixture::lasting(20.0),
        view: V::default(),
        time,
        commands: Vec::new(),
    };
    Harness::builder().with_size(size).build_ui_state(
        move |ui, state| {
            let mut context = state.fixture.context(state.time, &mut state.commands);
            draw(&mut state.view, ui, &mut context);
        },
        state,
    )
}
