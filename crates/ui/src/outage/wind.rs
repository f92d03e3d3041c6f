//! The wind as satellite navigation tells it, beside what else is known of it.

use egui::{Color32, Painter, Pos2, Rect, RichText, Sense, Shape, Stroke, Ui, Vec2, vec2};

use crate::context::ViewContext;
use crate::tokens::Tokens;
use crate::views::chart::ChartAxes;
use crate::views::{TimeAxis, parts, table};
use pilotage_jobs::WindReport;

/// Height of the curves, points.
const HEIGHT: f32 = 110.0;

/// Number of marks on a curve.
const MARKS: usize = 5;
/// Half the size of a mark, points.
const MARK: f32 = 3.5;

/// Form of the marks on the curves of a source.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mark {
    Disc,
    Square,
    Triangle,
}

impl Mark {
    fn paint(self, painter: &Painter, at: Pos2, colour: Color32) {
        match self {
            Self::Disc => {
                painter.circle_filled(at, MARK, colour);
            }
            Self::Square => {
                let rect = Rect::from_center_size(at, Vec2::splat(1.8 * MARK));
                painter.rect_filled(rect, 0.0, colour);
            }
            Self::Triangle => {
                let corners = [(0.0, -1.2), (1.1, 0.9), (-1.1, 0.9)];
                let corners = corners.map(|(x, y)| at + MARK * vec2(x, y));
                let shape = Shape::convex_polygon(corners.to_vec(), colour, Stroke::NONE);
                painter.add(shape);
            }
        }
    }
}

/// Colours and marks of the wind by the filter, by least squares and by the autopilot.
fn looks(tokens: &Tokens) -> [(Color32, Mark); 3] {
    [
        (tokens.accent, Mark::Disc),
        (tokens.truth, Mark::Square),
        (tokens.unaided, Mark::Triangle),
    ]
}

/// Place of a curve between its points at a time, if it has one there.
fn at_time(curve: &[[f64; 3]], time: f64) -> Option<[f64; 3]> {
    let next = curve.partition_point(|it| it[0] < time);
    let (to, from) = (curve.get(next)?, curve.get(next.saturating_sub(1))?);
    let span = to[0] - from[0];
    let share = if span > 0.0 {
        (time - from[0]) / span
    } else {
        0.0
    };
    (time >= from[0]).then(|| [0, 1, 2].map(|axis| from[axis] + share * (to[axis] - from[axis])))
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
    let row =
        |ui: &mut Ui, name: &str, look: (Color32, Mark), wind: [f64; 2], apart: Option<f64>| {
            let [north, east] = wind.map(|v| parts::figures(factor * v));
            let apart = apart.map_or_else(|| "–".to_owned(), |rms| parts::figures(factor * rms));
            table::row(ui, tokens, &[north, east, apart], tokens.text, |ui| {
                let (rect, _) = ui.allocate_exact_size(vec2(16.0, 12.0), Sense::hover());
                let ends = [rect.left_center(), rect.right_center()];
                let (colour, mark) = look;
                ui.painter().line_segment(ends, Stroke::new(1.5, colour));
                mark.paint(ui.painter(), rect.center(), colour);
                let label = RichText::new(name).color(tokens.text);
                ui.add(egui::Label::new(label).truncate());
            });
        };
    let [by_gps, by_fit, by_autopilot] = looks(tokens);
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
    for (number, (curve, (colour, mark))) in curves.into_iter().zip(looks(tokens)).enumerate() {
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
        // Those of the sources are beside each other.
        let first = (number as f64 + 1.0) / 4.0;
        for place in (0..MARKS).map(|index| (index as f64 + first) / MARKS as f64) {
            let Some(wind) = at_time(curve, span.0 + place * (span.1 - span.0)) else {
                continue;
            };
            for value in [wind[1], wind[2]] {
                mark.paint(&inside, axes.at(wind[0], factor * value), colour);
            }
        }
    }
    if (span.0..=span.1).contains(&context.time) {
        let x = axes.screen_x(context.time);
        inside.vline(x, rect.y_range(), Stroke::new(1.0, tokens.text));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sources_are_told_apart_without_their_colours() {
        let [(_, a), (_, b), (_, c)] = looks(&Tokens::dark());
        assert!(a != b && b != c && a != c);
    }

    #[test]
    fn marks_stand_on_the_curve_and_nowhere_beside_it() {
        let curve = [[0.0, 1.0, 0.0], [10.0, 3.0, 4.0]];
        assert_eq!(at_time(&curve, 5.0), Some([5.0, 2.0, 2.0]));
        assert_eq!(at_time(&curve, 10.5), None);
        assert_eq!(at_time(&curve, -0.5), None);
        assert_eq!(at_time(&[], 1.0), None);
    }
}
