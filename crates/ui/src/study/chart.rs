//! Plots of a study: a row for each setting, its dot with what it scatters.

use egui::{Align2, Color32, Painter, Rect, Sense, Stroke, Ui, pos2, vec2};

use crate::tokens::Tokens;
use crate::views::chart::ChartAxes;
use crate::views::parts;

/// Height of a row, points.
const ROW: f32 = 24.0;
/// Largest part of the width that labels take.
const LABELS: f32 = 0.42;

/// Dot of a row with its lines, on the scale of the plot.
pub struct PlottedDot {
    /// Value of the dot.
    pub value: f64,
    /// Ends of the thin line.
    pub thin: [f64; 2],
    /// Ends of the thick line, if it has one.
    pub thick: Option<[f64; 2]>,
    /// Value of a small mark across, if it has one.
    pub mark: Option<f64>,
    /// Colour.
    pub colour: Color32,
}

/// Row of a plot.
pub struct PlotRow<'a> {
    /// Its setting.
    pub label: &'a str,
    /// Its dot; `None` before there are any flights.
    pub dot: Option<PlottedDot>,
    /// All of it in words.
    pub words: String,
}

/// Scale of a plot.
pub struct PlotScale<'a> {
    /// Quantity and unit.
    pub name: &'a str,
    /// Values at the left and right edge.
    pub ends: (f64, f64),
    /// Value at which a line stands, with its name, if one does.
    pub line: Option<(f64, &'a str)>,
}

/// Draws a plot.
pub fn plot(ui: &mut Ui, tokens: &Tokens, scale: &PlotScale<'_>, rows: &[PlotRow<'_>]) {
    let width = ui.available_width();
    let font = parts::small(tokens);
    let widest = rows.iter().map(|row| {
        let text = row.label.to_owned();
        let galley = ui.painter().layout_no_wrap(text, font.clone(), tokens.text);
        galley.size().x
    });
    let labels = widest.fold(0.0, f32::max).min(LABELS * width) + tokens.space;
    let top = if scale.line.is_some() {
        1.6 * tokens.text_sizes[0]
    } else {
        0.0
    };
    // The numbers of the axis, and below them its name: beside them it would take the place of the last.
    let line = 1.4 * tokens.text_sizes[0];
    let below = 2.0 * line + 4.0;
    let height = top + ROW * rows.len() as f32 + below;
    let (outer, _) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
    let painter = ui.painter_at(outer);
    let rect = Rect::from_min_max(
        pos2(outer.left() + labels, outer.top() + top),
        pos2(outer.right() - tokens.space, outer.bottom() - below),
    );
    painter.rect_filled(rect, 2.0, tokens.background);
    let axes = ChartAxes {
        rect,
        x: scale.ends,
        y: (0.0, 1.0),
        log: false,
    };
    for (tick, _) in axes.x_ticks(tokens) {
        painter.vline(
            axes.screen_x(tick),
            rect.y_range(),
            Stroke::new(0.5, tokens.line),
        );
    }
    axes.draw_x(&painter, tokens, "");
    painter.text(
        pos2(rect.right(), rect.bottom() + 0.25 * tokens.space + line),
        Align2::RIGHT_TOP,
        scale.name,
        font.clone(),
        tokens.muted,
    );
    if let Some((value, name)) = scale.line {
        let x = axes.screen_x(value);
        painter.vline(x, rect.y_range(), Stroke::new(1.0, tokens.text));
        let at = pos2((x + 3.0).min(rect.right()), outer.top());
        painter.text(at, Align2::RIGHT_TOP, name, font.clone(), tokens.muted);
    }
    for (number, row) in rows.iter().enumerate() {
        let middle = rect.top() + ROW * (number as f32 + 0.5);
        let own = Rect::from_center_size(pos2(outer.center().x, middle), vec2(outer.width(), ROW));
        let id = ui.scope_id().with((scale.name, number));
        let response = ui.interact(own, id, Sense::hover());
        parts::name(&response, format!("{}: {}", row.label, row.words));
        let mut job = egui::text::LayoutJob::simple_singleline(
            row.label.to_owned(),
            font.clone(),
            tokens.text,
        );
        job.wrap = egui::text::TextWrapping::truncate_at_width(labels - tokens.space);
        let galley = painter.layout_job(job);
        let corner = pos2(outer.left(), middle - 0.5 * galley.size().y);
        painter.galley(corner, galley, tokens.text);
        if let Some(dot) = &row.dot {
            draw_dot(&painter, tokens, &axes, dot, middle);
        }
        response.on_hover_text(format!("{}: {}", row.label, row.words));
    }
}

fn draw_dot(painter: &Painter, tokens: &Tokens, axes: &ChartAxes, dot: &PlottedDot, y: f32) {
    let painter = painter.with_clip_rect(axes.rect.expand(4.0));
    let x = |value: f64| axes.screen_x(value);
    let [low, high] = dot.thin;
    painter.hline(x(low)..=x(high), y, Stroke::new(1.25, dot.colour));
    for end in dot.thin {
        painter.vline(x(end), y - 3.0..=y + 3.0, Stroke::new(1.25, dot.colour));
    }
    if let Some([low, high]) = dot.thick {
        painter.hline(
            x(low)..=x(high),
            y,
            Stroke::new(5.0, dot.colour.gamma_multiply(0.55)),
        );
    }
    if let Some(mark) = dot.mark {
        painter.vline(x(mark), y - 6.0..=y + 6.0, Stroke::new(1.5, tokens.muted));
    }
    let rim = Stroke::new(1.0, tokens.background);
    painter.circle(pos2(x(dot.value), y), 4.0, dot.colour, rim);
}
