//! The rows of a sheet of settings: a name, a slider, a unit, and one line on what it means.

use egui::{Response, Slider, SliderClamping, Ui};

use crate::shell::muted;
use crate::tokens::Tokens;

/// Draws a line on what the row above means.
pub(super) fn meaning(ui: &mut Ui, tokens: &Tokens, text: &str) {
    ui.label(muted(tokens, text));
    ui.add_space(4.0);
}

/// A row: the name at the left, the widget at the right, its unit behind it.
pub(super) fn named(
    ui: &mut Ui,
    name: &str,
    unit: &str,
    add: impl FnOnce(&mut Ui) -> Response,
) -> bool {
    ui.horizontal(|ui| {
        let label = ui.label(name);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let tokens_muted = ui.visuals().weak_text_color();
            let (rect, _) = ui.allocate_exact_size(egui::vec2(44.0, 20.0), egui::Sense::hover());
            ui.painter().text(
                rect.left_center(),
                egui::Align2::LEFT_CENTER,
                unit,
                egui::TextStyle::Small.resolve(ui.style()),
                tokens_muted,
            );
            ui.spacing_mut().slider_width = 96.0;
            add(ui).labelled_by(label.id).changed()
        })
        .inner
    })
    .inner
}

/// A logarithmic slider of a value shown `factor` times as large.
pub(super) fn scaled(
    ui: &mut Ui,
    name: &str,
    unit: &str,
    value: &mut f64,
    factor: f64,
    range: std::ops::RangeInclusive<f64>,
) -> bool {
    let look =
        |slider: Slider<'_>| slider_row(ui, name, unit, slider.logarithmic(true).max_decimals(3));
    edited(value, factor, range, look)
}

/// The same with one decimal, for how far is searched.
pub(super) fn limit_slider(
    ui: &mut Ui,
    name: &str,
    unit: &str,
    value: &mut f64,
    factor: f64,
    range: std::ops::RangeInclusive<f64>,
) -> bool {
    let look =
        |slider: Slider<'_>| slider_row(ui, name, unit, slider.logarithmic(true).max_decimals(1));
    edited(value, factor, range, look)
}

/// A slider of a value shown `factor` times as large, evenly from one end to the other.
pub(super) fn linear(
    ui: &mut Ui,
    name: &str,
    unit: &str,
    value: &mut f64,
    factor: f64,
    range: std::ops::RangeInclusive<f64>,
) -> bool {
    let look = |slider: Slider<'_>| slider_row(ui, name, unit, slider.max_decimals(1));
    edited(value, factor, range, look)
}

fn slider_row(ui: &mut Ui, name: &str, unit: &str, slider: Slider<'_>) -> bool {
    let slider = slider.clamping(SliderClamping::Edits);
    named(ui, name, unit, |ui| ui.add(slider))
}

/// Lets a slider change a value that is shown `factor` times as large; whether it did.
fn edited(
    value: &mut f64,
    factor: f64,
    range: std::ops::RangeInclusive<f64>,
    show: impl FnOnce(Slider<'_>) -> bool,
) -> bool {
    let mut shown = *value * factor;
    let range = range.start() * factor..=range.end() * factor;
    let changed = show(Slider::new(&mut shown, range));
    if changed {
        *value = shown / factor;
    }
    changed
}
