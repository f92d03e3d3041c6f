//! A whole picture laid on the map, in numbers.

use egui::{RichText, Ui};
use pilotage_core::filter::probability_words;
use pilotage_core::navigator::{JointReport, RegistrationReport, Run};
use pilotage_core::registration::RegistrationMethod;

use super::super::parts::{self, NumberReadout, figures};
use super::matrix;
use crate::context::ViewContext;

/// Draws the place of the picture and its probability and uncertainty, or why it was not believed.
pub(super) fn show(ui: &mut Ui, context: &ViewContext<'_>, laid: &RegistrationReport) {
    let tokens = context.tokens;
    if let Some(cause) = &laid.refusal {
        ui.label(
            RichText::new(format!("Not used: {cause}."))
                .size(tokens.text_sizes[0])
                .color(tokens.refused),
        );
    }
    if let Some(probability) = laid.probability {
        let reading = NumberReadout::new("likeliest place", probability_words(probability), "");
        parts::reading(ui, tokens, &reading);
    }
    let Some(place) = &laid.place else { return };
    let agreeing = format!("{} of {}", place.matches.len(), laid.tried);
    parts::reading(
        ui,
        tokens,
        &NumberReadout::new("patches that agree", agreeing, ""),
    );
    let doubt = match laid.laid_by {
        RegistrationMethod::Patches => "as many by chance",
        RegistrationMethod::WholeFrame => "elsewhere, or not here",
    };
    let chance = format!("10^{:.0}", laid.log_false_alarms);
    parts::reading(ui, tokens, &NumberReadout::new(doubt, chance, ""));
    let (factor, unit) = context.units.length();
    let deviation = |i: usize| place.covariance[(i, i)].max(0.0).sqrt();
    let position = place.pose.position_in_world;
    let ground = context.flight.map_or(0.0, |flight| flight.ground_down);
    for (name, value, i) in [
        ("north", position.x, 0),
        ("east", position.y, 1),
        ("height above ground", ground - position.z, 2),
    ] {
        let reading = NumberReadout::new(name, parts::brief(factor * value), unit);
        parts::reading(
            ui,
            tokens,
            &reading.deviation(figures(factor * deviation(i))),
        );
    }
    let attitude = place.pose.attitude;
    let degrees = 1_f64.to_degrees();
    for (name, value, i) in [
        ("roll", attitude.roll, 3),
        ("pitch", attitude.pitch, 4),
        ("heading", attitude.yaw.rem_euclid(std::f64::consts::TAU), 5),
    ] {
        let value = parts::brief(degrees * value);
        let value = if value == "360" {
            "0".to_owned()
        } else {
            value
        };
        let reading = NumberReadout::new(name, value, "°");
        parts::reading(
            ui,
            tokens,
            &reading.deviation(figures(degrees * deviation(i))),
        );
    }
    let stretch = 100.0 * (place.shape.ratio() - 1.0);
    let toward = degrees * place.shape.direction();
    let map = NumberReadout::new(
        format!("map stretched along {toward:.0}°"),
        figures(stretch),
        "%",
    );
    parts::reading(ui, tokens, &map);
    if place.stored_turn != 0.0 {
        let turn = figures(degrees * place.stored_turn);
        parts::reading(
            ui,
            tokens,
            &NumberReadout::new("picture stored turned by", turn, "°"),
        );
    }
}

/// Draws the correction by the place of the picture: innovation with σ and gain.
pub(super) fn correction(ui: &mut Ui, context: &ViewContext<'_>, run: &Run, joint: &JointReport) {
    const AXES: [&str; 2] = ["north", "east"];
    let tokens = context.tokens;
    let (factor, unit) = context.units.length();
    for (i, name) in AXES.iter().enumerate().take(joint.innovation.len()) {
        let sigma = joint.innovation_covariance[(i, i)].max(0.0).sqrt();
        let value = parts::brief(factor * joint.innovation[i]);
        let reading = NumberReadout::new(format!("picture {name} of expected"), value, unit);
        parts::reading(ui, tokens, &reading.deviation(figures(factor * sigma)));
    }
    ui.label(
        RichText::new("Kalman gain: what one metre moves each component by, SI")
            .size(tokens.text_sizes[0])
            .color(tokens.muted),
    );
    let rows: Vec<String> = run.state_names.iter().map(|(n, _)| n.clone()).collect();
    let rows = &rows[..joint.gain.nrows().min(rows.len())];
    let columns = AXES.map(str::to_owned);
    if joint.gain.ncols() == columns.len() {
        matrix::gain(ui, tokens, &joint.gain, rows, &columns, "whole picture");
    }
}
