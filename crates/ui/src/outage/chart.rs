//! Growth of the error during a GPS outage.

use egui::{Color32, Shape, Stroke, Ui};

use crate::tokens::Tokens;
use crate::views::chart::ChartAxes;
use crate::views::{TimeAxis, parts};
use pilotage_jobs::AidedResult;

/// Height of the curves, points.
const HEIGHT: f32 = 150.0;

/// Colour of the n-th way to navigate.
pub(crate) fn colour(tokens: &Tokens, number: usize) -> Color32 {
    let colours = [
        tokens.dead_reckoning,
        tokens.accent,
        tokens.unaided,
        tokens.truth,
        tokens.observed,
    ];
    colours[number % colours.len()]
}

/// Draws error (line) and the radius that should hold it in 95 of 100 cases (dashes) against the time since
/// GPS was lost.
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
        let colour = colour(tokens, number);
        let radius = result
            .growth
            .iter()
            .map(|p| axes.at(p.since, factor * p.radius));
        let radius: Vec<_> = radius.collect();
        let faint = Stroke::new(1.0, colour.gamma_multiply(0.7));
        inside.extend(Shape::dashed_line(&radius, faint, 4.0, 3.0));
        let line = result.growth.iter();
        let line = line.filter_map(|p| Some(axes.at(p.since, factor * p.error?)));
        inside.add(Shape::line(line.collect(), Stroke::new(1.75, colour)));
    }
    if let Some(since) = cursor.filter(|t| (0.0..=last).contains(t)) {
        let stroke = Stroke::new(1.0, tokens.accent);
        inside.vline(axes.screen_x(since), rect.y_range(), stroke);
    }
}
