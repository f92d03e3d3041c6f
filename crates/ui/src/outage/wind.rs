//! The wind as satellite navigation tells it, beside what else is known of it.

use egui::{Color32, RichText, Sense, Shape, Stroke, Ui, vec2};

use crate::context::ViewContext;
use crate::tokens::Tokens;
use crate::views::chart::ChartAxes;
use crate::views::{TimeAxis, parts, table};
use pilotage_jobs::WindReport;

/// Height of the curves, points.
const HEIGHT: f32 = 110.0;

/// Colours of the wind by the filter, by least squares and by the autopilot.
fn colours(tokens: &Tokens) -> [Color32; 3] {
    [tokens.accent, tokens.truth, tokens.unaided]
}

/// Draws the winds: a table and their course over the flight.
pub(super) fn winds(ui: &mut Ui, context: &ViewContext<'_>, report: &WindReport) {
    let tokens = context.tokens;
    let (factor, unit) = context.units.speed();
    let small = |text: String| {
        RichText::new(text)
            .size(tokens.text_sizes[0])
            .color(tokens.muted)
    };
    ui.add_space(tokens.space);
    ui.label(
        RichText::new("Wind, by GPS")
            .color(tokens.text)
            .font(tokens.heading()),
    );
    let titles = ["north", "east", "apart"].map(str::to_owned);
    table::heads(ui, tokens, &titles, |ui| {
        ui.label(small(format!("where the air goes, {unit}")));
    });
    let row = |ui: &mut Ui, name: &str, colour: Color32, wind: [f64; 2], apart: Option<f64>| {
        let [north, east] = wind.map(|v| parts::figures(factor * v));
        let apart = apart.map_or_else(|| "–".to_owned(), |rms| parts::figures(factor * rms));
        table::row(ui, tokens, &[north, east, apart], tokens.text, |ui| {
            let (rect, _) = ui.allocate_exact_size(vec2(12.0, 12.0), Sense::hover());
            let ends = [rect.left_center(), rect.right_center()];
            ui.painter().line_segment(ends, Stroke::new(2.5, colour));
            let label = RichText::new(name).color(tokens.text);
            ui.add(egui::Label::new(label).truncate());
        });
    };
    let [by_gps, by_fit, by_autopilot] = colours(tokens);
    let last = |winds: &[[f64; 3]]| winds.last().map(|w| [w[1], w[2]]);
    if let Some(wind) = last(&report.by_gps) {
        row(ui, "Unscented filter, at the end", by_gps, wind, None);
    }
    if let Some(wind) = report.by_least_squares {
        row(ui, "Least squares", by_fit, wind, report.from_least_squares);
    }
    match last(&report.by_autopilot) {
        Some(wind) => row(
            ui,
            "Autopilot, at the end",
            by_autopilot,
            wind,
            report.from_autopilot,
        ),
        None => {
            ui.label(small("The log holds no wind of the autopilot.".to_owned()));
        }
    }
    course(ui, context, report);
    let words = "Lines: north; dashes: east. Apart: root mean square of the filter's difference from the other, from a \
                 minute after take-off on. The filter is that of DeAngelo 2016, Table 4.";
    ui.add(egui::Label::new(small(words.to_owned())).wrap());
}

/// Both components against time.
fn course(ui: &mut Ui, context: &ViewContext<'_>, report: &WindReport) {
    let tokens = context.tokens;
    let (factor, unit) = context.units.speed();
    let labels = 1.8 * tokens.text_sizes[0] + 4.0;
    let size = vec2(ui.available_width(), HEIGHT + labels);
    let (outer, response) = ui.allocate_exact_size(size, Sense::hover());
    parts::name(&response, format!("Wind over time, {unit}"));
    let (Some(first), Some(last)) = (report.by_gps.first(), report.by_gps.last()) else {
        return;
    };
    let span = (first[0], last[0]);
    if span.1 <= span.0 {
        return;
    }
    let fitted = report.by_least_squares.into_iter();
    let level = fitted.flat_map(|[north, east]| [[span.0, north, east], [span.1, north, east]]);
    let level: Vec<[f64; 3]> = level.collect();
    let curves = [&report.by_gps[..], &level, &report.by_autopilot];
    let values = curves.iter().flat_map(|curve| curve.iter());
    let (low, high) = values
        .flat_map(|w| [w[1], w[2]])
        .fold((0.0_f64, 0.0_f64), |(low, high), v| {
            (low.min(v), high.max(v))
        });
    let margin = 0.08 * (high - low).max(0.1);
    let mut rect = TimeAxis::curves_rect(outer, tokens);
    rect.set_height(HEIGHT);
    let painter = ui.painter_at(outer);
    painter.rect_filled(rect, 2.0, tokens.background);
    let axes = ChartAxes {
        rect,
        x: span,
        y: (factor * (low - margin), factor * (high + margin)),
        log: false,
    };
    axes.draw_y(&painter, tokens);
    axes.draw_time(&painter, tokens, context.clock_zero);
    let inside = painter.with_clip_rect(rect);
    for (curve, colour) in curves.into_iter().zip(colours(tokens)) {
        let line = |axis: usize| -> Vec<_> {
            let points = curve.iter();
            points.map(|w| axes.at(w[0], factor * w[axis])).collect()
        };
        inside.add(Shape::line(line(1), Stroke::new(1.5, colour)));
        inside.extend(Shape::dashed_line(
            &line(2),
            Stroke::new(1.5, colour),
            5.0,
            3.0,
        ));
    }
    if (span.0..=span.1).contains(&context.time) {
        let x = axes.screen_x(context.time);
        inside.vline(x, rect.y_range(), Stroke::new(1.0, tokens.text));
    }
}
