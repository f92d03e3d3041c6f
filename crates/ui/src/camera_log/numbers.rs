//! The estimate as a table, and the same numbers to be moved by hand.

use egui::{Align2, RichText, Role, Sense, Slider, SliderClamping, Ui, WidgetInfo, vec2};
use pilotage_core::calibration::{CameraAdjustment, CameraNumber, CameraToLog, camera_numbers};

use super::work::FoundCamera;
use crate::tokens::Tokens;
use crate::units::Units;
use crate::views::{parts, table};

/// Height of a row with a slider, points.
const ROW: f32 = 20.0;
/// Farthest that the mount's angles are offered to be turned, degrees.
const MOST_ANGLE: f64 = 20.0;
/// Farthest that the focal length is offered to be changed, percent.
const MOST_FOCAL: f64 = 30.0;
/// Fastest drift that is offered, microseconds per second.
const MOST_DRIFT: f64 = 2000.0;

/// A number with a sign where it is below zero, as its deviation deserves.
fn rounded(value: f64, deviation: f64) -> String {
    let decimals = match deviation {
        d if d >= 10.0 => 0,
        d if d >= 1.0 => 1,
        d if d >= 0.1 => 2,
        _ => 3,
    };
    format!("{value:.decimals$}").replace('-', "−")
}

/// Draws the estimate.
pub(super) fn estimate(ui: &mut Ui, tokens: &Tokens, found: &FoundCamera, units: Units) {
    let small = |text: &str| {
        RichText::new(text)
            .size(tokens.text_sizes[0])
            .color(tokens.muted)
    };
    ui.spacing_mut().item_spacing.y = 0.0;
    let titles = ["estimate", "± σ"].map(str::to_owned);
    table::heads(ui, tokens, &titles, |ui| {
        ui.label(small("to be added to the flight as opened"));
    });
    let (length, length_unit) = units.length();
    for number in camera_numbers(&found.change, &found.told) {
        let (factor, unit) = match number.unit {
            "m" => (length, length_unit),
            other => (1.0, other),
        };
        let line = CameraNumber {
            value: factor * number.value,
            deviation: factor * number.deviation,
            ..number
        };
        let colour = if line.is_told {
            tokens.text
        } else {
            tokens.muted
        };
        let deviation = rounded(line.deviation, line.deviation);
        let cells = [
            rounded(line.value, line.deviation),
            format!("± {deviation}"),
        ];
        table::row(ui, tokens, &cells, colour, |ui| {
            ui.label(RichText::new(format!("{}, {unit}", line.name)).color(colour));
            if !line.is_told {
                ui.label(small("not told by this flight"));
            }
        });
    }
    scatter(ui, tokens, &found.told, units);
}

/// Frames, and how the fixes scatter about them.
fn scatter(ui: &mut Ui, tokens: &Tokens, told: &CameraToLog, units: Units) {
    let (length, unit) = units.length();
    let [before, after] = told.place_deviation.map(|d| parts::figures(length * d));
    let words = format!(
        "{} frames. GPS scatters about them by {before} {unit} before, {after} {unit} after (σ per axis).",
        told.frames
    );
    let words = RichText::new(words)
        .size(tokens.text_sizes[0])
        .color(tokens.muted);
    ui.add(egui::Label::new(words).wrap());
}

/// A slider; whether it was moved.
fn slider(
    ui: &mut Ui,
    tokens: &Tokens,
    (name, unit): (&str, &str),
    (value, most): (&mut f64, f64),
    decimals: usize,
) -> bool {
    ui.horizontal(|ui| {
        let (rect, label) = ui.allocate_exact_size(vec2(88.0, ROW), Sense::hover());
        label.widget_info(|| WidgetInfo::labeled(Role::Label, true, name));
        let (at, font) = (rect.left_center(), parts::normal(tokens));
        ui.painter()
            .text(at, Align2::LEFT_CENTER, name, font, tokens.text);
        ui.spacing_mut().interact_size.y = ROW;
        ui.spacing_mut().button_padding.y = 1.0;
        ui.spacing_mut().slider_width = (ui.available_width() - 116.0).max(60.0);
        let slider = Slider::new(value, -most..=most)
            .clamping(SliderClamping::Never)
            .fixed_decimals(decimals)
            .suffix(format!(" {unit}"));
        ui.add(slider).accessible_name(name).changed()
    })
    .inner
}

/// Draws the numbers that the hand moves; the new ones if it did. Times are offered up to `most_offset`, seconds.
pub(super) fn by_hand(
    ui: &mut Ui,
    tokens: &Tokens,
    change: &CameraAdjustment,
    most_offset: f64,
) -> Option<CameraAdjustment> {
    let mut moved = *change;
    let mut offset = change.offset;
    let mut drift = 1e6 * change.drift;
    let mut angles = [change.roll, change.pitch, change.yaw].map(f64::to_degrees);
    let mut focal = change.focal_percent();
    if slider(
        ui,
        tokens,
        ("Time offset", "s"),
        (&mut offset, most_offset),
        2,
    ) {
        moved.offset = offset;
    }
    let words = ("Clock drift", "µs/s");
    if slider(ui, tokens, words, (&mut drift, MOST_DRIFT), 0) {
        moved.drift = 1e-6 * drift;
    }
    let names = ["Mount roll", "Mount pitch", "Mount yaw"];
    let into = [&mut moved.roll, &mut moved.pitch, &mut moved.yaw];
    for ((name, angle), into) in names.into_iter().zip(&mut angles).zip(into) {
        if slider(ui, tokens, (name, "°"), (angle, MOST_ANGLE), 2) {
            *into = angle.to_radians();
        }
    }
    if slider(
        ui,
        tokens,
        ("Focal length", "%"),
        (&mut focal, MOST_FOCAL),
        1,
    ) {
        moved.log_focal = (0.01 * focal).max(-0.9).ln_1p();
    }
    (moved != *change && moved.is_sound()).then_some(moved)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_as_their_deviation_deserves() {
        assert_eq!(rounded(-0.6612, 0.141), "−0.66");
        assert_eq!(rounded(12.34, 23.0), "12");
        assert_eq!(rounded(0.012_34, 0.004), "0.012");
    }
}
