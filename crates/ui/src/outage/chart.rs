//! Growth of the error during a GPS outage.

use egui::{Color32, Shape, Stroke, Ui};

use crate::tokens::Tokens;
use crate::views::chart::{ChartAxes, Dash, dashed};
use crate::views::{TimeAxis, parts};
use pilotage_jobs::AidedResult;

/// Height of the curves, points.
const HEIGHT: f32 = 150.0;
/// Radius of the dots of a radius, and their distance where its line is drawn through, points.
const DOT: f32 = 0.9;
const CLOSE: f32 = 3.5;

/// Colour and dash of the n-th way to navigate.
pub(super) fn look(tokens: &Tokens, number: usize) -> (Color32, Dash) {
    let looks = [
        (tokens.dead_reckoning, None),
        (tokens.accent, Some((7.0, 3.0))),
        (tokens.unaided, Some((2.0, 3.0))),
        (tokens.truth, Some((10.0, 4.0))),
        (tokens.observed, Some((4.0, 4.0))),
    ];
    looks[number % looks.len()]
}

/// Draws error (line) and the radius that should hold it in 95 of 100 cases (dots, as far apart as the line's dashes)
/// against the time since GPS was lost.
pub(super) fn growth_chart(
    ui: &mut Ui,
    tokens: &Tokens,
    results: &[AidedResult],
    (factor, unit): (f64, &str),
    cursor: Option<f64>,
) {
    let size = egui::vec2(
        ui.available_width(),
        HEIGHT + 1.8 * tokens.text_sizes[0] + 4.0,
    );
    let (outer, response) = ui.allocate_exact_size(size, egui::Sense::hover());
    parts::name(
        &response,
        format!("Error against the time since GPS was lost, {unit}"),
    );
    let ends = results.iter().filter_map(|r| r.growth.last());
    let last = ends.map(|p| p.since).fold(0.0, f64::max);
    let errors = results.iter().flat_map(|r| &r.growth);
    let most = errors
        .map(|p| p.error.unwrap_or(0.0).max(p.radius))
        .fold(1e-3, f64::max);
    let mut rect = TimeAxis::curves_rect(outer, tokens);
    rect.set_height(HEIGHT);
    let painter = ui.painter_at(outer);
    painter.rect_filled(rect, 2.0, tokens.background);
    if last <= 0.0 {
        return;
    }
    let axes = ChartAxes {
        rect,
        x: (0.0, last),
        y: (0.0, 1.06 * factor * most),
        log: false,
    };
    axes.draw_y(&painter, tokens);
    axes.draw_x(&painter, tokens, "since GPS was lost, s");
    let inside = painter.with_clip_rect(rect);
    for (number, result) in results.iter().enumerate() {
        let (colour, dash) = look(tokens, number);
        let radius = result
            .growth
            .iter()
            .map(|p| axes.at(p.since, factor * p.radius));
        let radius: Vec<_> = radius.collect();
        let apart = dash.map_or(CLOSE, |(dash, gap)| dash + gap);
        let faint = colour.gamma_multiply(0.7);
        inside.extend(Shape::dotted_line(&radius, faint, apart, DOT));
        let line = result.growth.iter();
        let line = line.filter_map(|p| Some(axes.at(p.since, factor * p.error?)));
        inside.extend(dashed(line.collect(), Stroke::new(1.75, colour), dash));
    }
    if let Some(since) = cursor.filter(|t| (0.0..=last).contains(t)) {
        let stroke = Stroke::new(1.0, tokens.accent);
        inside.vline(axes.screen_x(since), rect.y_range(), stroke);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_are_told_apart_without_their_colours() {
        let tokens = Tokens::dark();
        let looks: Vec<_> = (0..5).map(|number| look(&tokens, number)).collect();
        for (number, (_, dash)) in looks.iter().enumerate() {
            assert!(looks[..number].iter().all(|(_, other)| other != dash));
        }
    }
}
