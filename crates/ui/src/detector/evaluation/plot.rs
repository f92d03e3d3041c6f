//! Draws a plot of an evaluation.

use egui::{
    Align2, Color32, Mesh, Painter, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2,
    vec2,
};
use pilotage_core::training::evaluation::{Plot, PlotPoint, PlotSeries, SeriesStyle};

use crate::tokens::Tokens;
use crate::views::chart::{Dash, dashed};

/// Room at the left and below what is drawn in, points.
const LEFT: f32 = 34.0;
const BELOW: f32 = 34.0;
/// Height of a line of small text, points.
const LINE: f32 = 16.0;
/// From how far a point under the pointer is read, points.
const NEAR: f32 = 40.0;

/// Frame that maps a plot's values to places on the screen.
struct PlotFrame<'a> {
    plot: &'a Plot,
    rect: Rect,
}

impl PlotFrame<'_> {
    fn at(&self, x: f64, y: f64) -> Pos2 {
        let (x, y) = (self.plot.x.fraction(x), self.plot.y.fraction(y));
        pos2(
            self.rect.left() + x as f32 * self.rect.width(),
            self.rect.bottom() - y as f32 * self.rect.height(),
        )
    }
}

/// Draws a plot into the space that is left.
pub(super) fn paint(ui: &mut Ui, plot: &Plot, tokens: &Tokens) {
    let (outer, response) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
    let counted: usize = plot.series.iter().map(|s| s.points.len()).sum();
    let words = format!(
        "{}: {} against {}, {counted} points",
        plot.title, plot.y.label, plot.x.label
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, words.clone()));
    let painter = ui.painter_at(outer);
    let series_lines = if plot.series.len() > 1 {
        plot.series.len() as f32
    } else {
        0.0
    };
    let frame = PlotFrame {
        plot,
        rect: Rect::from_min_max(
            outer.min + vec2(LEFT, LINE * (1.0 + series_lines) + 2.0),
            outer.max - vec2(12.0, BELOW),
        ),
    };
    if frame.rect.height() < 40.0 || frame.rect.width() < 80.0 {
        return;
    }
    let small = |at: Pos2, align: Align2, text: &str, color: Color32| {
        painter.text(at, align, text, tokens.small(), color)
    };
    small(outer.min, Align2::LEFT_TOP, &plot.y.label, tokens.muted);
    let looks = looks(tokens);
    if series_lines > 0.0 {
        for (line, (series, (color, dash))) in plot.series.iter().zip(looks).enumerate() {
            let at = outer.min + vec2(LEFT, LINE * (line as f32 + 1.5));
            let ends = vec![at, at + vec2(24.0, 0.0)];
            painter.extend(dashed(ends, Stroke::new(2.0, color), dash));
            small(
                at + vec2(30.0, 0.0),
                Align2::LEFT_CENTER,
                &series.name,
                tokens.muted,
            );
        }
    } else if let Some(series) = plot.series.first() {
        let right = pos2(outer.right() - 12.0, outer.top());
        let has_room = outer.width() > 380.0;
        if has_room {
            small(right, Align2::RIGHT_TOP, &series.name, tokens.muted);
        }
    }
    paint_axes(&painter, &frame, tokens);
    let thin = |from: Pos2, to: Pos2| {
        let stroke = Stroke::new(1.0, tokens.muted);
        painter.extend(Shape::dashed_line(&[from, to], stroke, 5.0, 4.0));
    };
    if plot.diagonal {
        thin(frame.rect.left_bottom(), frame.rect.right_top());
    }
    if let Some((x, words)) = &plot.limit {
        let at = frame.at(*x, plot.y.low);
        thin(at, pos2(at.x, frame.rect.top()));
        let (align, y) = if plot.limit_below() {
            (Align2::RIGHT_BOTTOM, frame.rect.bottom() - 2.0)
        } else {
            (Align2::RIGHT_TOP, frame.rect.top() + 2.0)
        };
        small(pos2(at.x - 4.0, y), align, words, tokens.muted);
    }
    for (series, look) in plot.series.iter().zip(looks) {
        paint_series(&painter, &frame, series, look);
    }
    let nearest = response.hover_pos().and_then(|at| nearest(&frame, at));
    if let Some(point) = nearest {
        painter.circle_stroke(
            frame.at(point.x, point.y),
            5.0,
            Stroke::new(1.5, tokens.text),
        );
        response.on_hover_text_at_pointer(reading(plot, &point));
    }
}

/// Values of the point under the pointer, in words.
fn reading(plot: &Plot, point: &PlotPoint) -> String {
    let x = format!("{:.4}", point.x);
    let x = x.trim_end_matches('0').trim_end_matches('.');
    format!(
        "{}: {x}\n{}: {:.1} ({:.1} to {:.1})",
        plot.x.label, plot.y.label, point.y, point.low, point.high
    )
}

fn nearest(frame: &PlotFrame<'_>, pointer: Pos2) -> Option<PlotPoint> {
    let away = |p: &PlotPoint| frame.at(p.x, p.y).distance(pointer);
    let points = frame.plot.series.iter().flat_map(|s| s.points.iter());
    let nearest = points.min_by(|a, b| away(a).total_cmp(&away(b)))?;
    (away(nearest) < NEAR).then_some(*nearest)
}

fn paint_axes(painter: &Painter, frame: &PlotFrame<'_>, tokens: &Tokens) {
    let (plot, rect) = (frame.plot, frame.rect);
    let thin = Stroke::new(0.5, tokens.line);
    let text = |at: Pos2, align: Align2, words: &str| {
        painter.text(at, align, words, tokens.small(), tokens.muted);
    };
    let most = |room: f32, each: f32| ((room / each) as usize).clamp(2, 8);
    for (value, label) in plot.x.ticks(most(rect.width(), 52.0)) {
        let at = frame.at(value, plot.y.low);
        painter.vline(at.x, rect.y_range(), thin);
        text(at + vec2(0.0, 3.0), Align2::CENTER_TOP, &label);
    }
    for (value, label) in plot.y.ticks(most(rect.height(), 34.0)) {
        let at = frame.at(plot.x.low, value);
        painter.hline(rect.x_range(), at.y, thin);
        text(at - vec2(5.0, 0.0), Align2::RIGHT_CENTER, &label);
    }
    let below = rect.center_bottom() + vec2(0.0, 3.0 + LINE);
    text(below, Align2::CENTER_TOP, &plot.x.label);
}

/// Colours and dashes of the series.
fn looks(tokens: &Tokens) -> [(Color32, Dash); 2] {
    [
        (tokens.dead_reckoning, None),
        (tokens.accent, Some((7.0, 4.0))),
    ]
}

fn paint_series(
    painter: &Painter,
    frame: &PlotFrame<'_>,
    series: &PlotSeries,
    (color, dash): (Color32, Dash),
) {
    if series.style == SeriesStyle::Dots {
        for point in &series.points {
            let bar = [point.low, point.high].map(|y| frame.at(point.x, y));
            painter.line_segment(bar, Stroke::new(2.0, color.gamma_multiply(0.7)));
            painter.circle_filled(frame.at(point.x, point.y), 3.5, color);
        }
        return;
    }
    let corners = series.corners();
    let mut band = Mesh::default();
    for (index, point) in (0_u32..).zip(&corners) {
        for y in [point.low, point.high] {
            band.colored_vertex(frame.at(point.x, y), color.gamma_multiply(0.22));
        }
        if index > 0 {
            let first = 2 * (index - 1);
            band.add_triangle(first, first + 1, first + 2);
            band.add_triangle(first + 1, first + 2, first + 3);
        }
    }
    painter.add(Shape::mesh(band));
    let line = corners.iter().map(|p| frame.at(p.x, p.y)).collect();
    painter.extend(dashed(line, Stroke::new(2.0, color), dash));
}
