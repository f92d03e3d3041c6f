//! Share of the views in which a landmark was found, in cells: over heights and tilts, by heading, attitude
//! error, day.

use egui::{Align2, Color32, Painter, Rect, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo};
use egui::{pos2, vec2};
use pilotage_core::plan::{Envelope, LookTally, ViewBreakdown};

use crate::context::ViewContext;
use crate::shell::{caption, muted};
use crate::tokens::Tokens;
use crate::units::Units;
use crate::views::color_map::viridis;
use crate::views::ellipse::largest_sigma;

/// Height of a cell, points.
const CELL: f32 = 30.0;
/// Width of the names of rows, points.
const LEFT: f32 = 64.0;
/// Height of a line of small text, points.
const LINE: f32 = 15.0;
/// Height of a line of the legend, points.
const LEGEND_LINE: f32 = 18.0;

/// The name of a strip, what each of its cells is of, and the cells.
type Strip<'a> = (&'a str, Vec<String>, &'a [LookTally]);

/// Draws by what the views of a landmark differ.
pub fn breakdown(ui: &mut Ui, counted: &ViewBreakdown, context: &ViewContext<'_>) {
    let words = "Found / looked for, and how far the found place scatters (±1σ):";
    ui.label(muted(context.tokens, words));
    let [small, great] = counted.edges.map(f64::to_degrees);
    let strips: [Strip<'_>; 3] = [
        (
            "Heading",
            ["N", "E", "S", "W"].map(str::to_owned).to_vec(),
            &counted.heading,
        ),
        (
            "Tilt error",
            vec![
                format!("under {small:.1}°"),
                format!("to {great:.1}°"),
                "over that".to_owned(),
            ],
            &counted.attitude_error,
        ),
        (
            "Day",
            (1..=counted.day.len()).map(|d| d.to_string()).collect(),
            &counted.day,
        ),
    ];
    for (name, labels, tallies) in strips {
        strip(ui, name, &labels, tallies, context);
    }
}

fn strip(
    ui: &mut Ui,
    name: &str,
    labels: &[String],
    tallies: &[LookTally],
    context: &ViewContext<'_>,
) {
    let tokens = context.tokens;
    let size = vec2(ui.available_width(), CELL + LINE + 4.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let words: Vec<String> = (labels.iter().zip(tallies))
        .map(|(label, t)| format!("{label} {} of {}", t.found, t.looks))
        .collect();
    let words = format!("Found by {}: {}", name.to_lowercase(), words.join(", "));
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, words.clone()));
    let painter = ui.painter_at(rect);
    let at = rect.left_top() + vec2(0.0, 0.5 * CELL);
    painter.text(at, Align2::LEFT_CENTER, name, tokens.small(), tokens.text);
    for (index, (label, tally)) in labels.iter().zip(tallies).enumerate() {
        let cell = place(rect, index, labels.len(), 0);
        paint_tally(&painter, cell, tally, tokens, context.units);
        let below = cell.center_bottom() + vec2(0.0, 1.0);
        painter.text(
            below,
            Align2::CENTER_TOP,
            label,
            tokens.small(),
            tokens.muted,
        );
    }
}

/// Cell `index` of `count` in a row.
fn place(rect: Rect, index: usize, count: usize, row: usize) -> Rect {
    let width = (rect.width() - LEFT) / count.max(1) as f32;
    let left = rect.left() + LEFT + width * index as f32;
    let top = rect.top() + CELL * row as f32;
    Rect::from_min_size(pos2(left, top), vec2(width, CELL)).shrink(1.5)
}

/// Draws from which heights and with which tilts a landmark is found; `height` is the planned one, metres.
pub fn envelope(ui: &mut Ui, envelope: &Envelope, height: f64, context: &ViewContext<'_>) {
    let tokens = context.tokens;
    let (factor, unit) = context.units.length();
    caption(ui, tokens, "From where it is found");
    let rows = envelope.heights.len();
    let size = vec2(ui.available_width(), CELL * rows as f32 + LINE + 4.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let looks: usize = envelope.cells.iter().map(|c| c.looks).sum();
    let words = format!(
        "Detection envelope: {rows} heights by {} tilts, {looks} looks",
        envelope.tilts.len()
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, words.clone()));
    let painter = ui.painter_at(rect);
    for (row, at) in envelope.heights.iter().enumerate().rev() {
        // The highest at the top.
        let line = rows - 1 - row;
        let y = rect.top() + CELL * (line as f32 + 0.5);
        let planned = (at - height).abs() < 0.5;
        let color = if planned { tokens.accent } else { tokens.text };
        let text = format!("{:.0} {unit}", at * factor);
        let end = pos2(rect.left() + LEFT - 8.0, y);
        painter.text(end, Align2::RIGHT_CENTER, text, tokens.small(), color);
        for tilt in 0..envelope.tilts.len() {
            if let Some(tally) = envelope.at(row, tilt) {
                let cell = place(rect, tilt, envelope.tilts.len(), line);
                paint_tally(&painter, cell, tally, tokens, context.units);
            }
        }
    }
    let bottom = rect.top() + CELL * rows as f32;
    for (index, tilt) in envelope.tilts.iter().enumerate() {
        let cell = place(rect, index, envelope.tilts.len(), 0);
        let at = pos2(cell.center().x, bottom + 1.0);
        let text = format!("{:.0}°", tilt.to_degrees());
        painter.text(at, Align2::CENTER_TOP, text, tokens.small(), tokens.text);
    }
    let words = "Upwards: height above ground, the planned one marked. To the right: tilt.";
    ui.label(muted(tokens, words));
}

/// Draws the legend of the cells.
pub fn legend(ui: &mut Ui, tokens: &Tokens) {
    let size = vec2(ui.available_width(), 2.0 * LEGEND_LINE);
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let painter = ui.painter_at(rect);
    let (upper, lower) = rect.split_top_bottom_at_fraction(0.5);
    let text = |line: Rect, x: f32, words: &str| {
        let at = pos2(x, line.center().y);
        let font = tokens.small();
        let drawn = painter.text(at, Align2::LEFT_CENTER, words, font, tokens.muted);
        drawn.right()
    };
    let x = text(upper, upper.left(), "Found: never") + 6.0;
    for i in 0..24 {
        let left = x + 3.0 * i as f32;
        let piece =
            Rect::from_x_y_ranges(left..=left + 3.5, upper.top() + 4.0..=upper.bottom() - 4.0);
        painter.rect_filled(piece, 0.0, viridis(i as f32 / 23.0));
    }
    text(upper, x + 78.0, "always");
    let hollow = Rect::from_min_size(lower.left_top() + vec2(0.0, 4.0), vec2(16.0, 10.0));
    let line = Stroke::new(1.0, tokens.muted);
    painter.rect_stroke(hollow, 2.0, line, StrokeKind::Inside);
    let x = text(lower, lower.left() + 22.0, "not looked for") + 14.0;
    painter.circle_filled(pos2(x + 3.0, lower.center().y), 3.5, tokens.warning);
    text(lower, x + 11.0, "a wrong place believed");
}

/// A cell: its colour is the share that was found; hollow without a look, a dot where wrong places were
/// believed; where there is room the deviation of the place in the direction where it is greatest.
fn paint_tally(painter: &Painter, cell: Rect, tally: &LookTally, tokens: &Tokens, units: Units) {
    let Some(share) = tally.share() else {
        let line = Stroke::new(1.0, tokens.line);
        painter.rect_stroke(cell, 3.0, line, StrokeKind::Inside);
        return;
    };
    let fill = viridis(share as f32);
    painter.rect_filled(cell, 3.0, fill);
    let ink = if share > 0.55 {
        Color32::from_gray(16)
    } else {
        Color32::from_gray(240)
    };
    let (factor, unit) = units.length();
    let place = tally.covariance().filter(|_| cell.width() > 52.0);
    let lines = [
        Some(format!("{} / {}", tally.found, tally.looks)),
        place.map(|c| format!("±{:.2} {unit}", largest_sigma(&c) * factor)),
    ];
    let lines: Vec<String> = lines.into_iter().flatten().collect();
    let galley = painter.layout_no_wrap(lines.join("\n"), tokens.small(), ink);
    let corner = cell.center() - 0.5 * galley.size();
    painter.galley(corner, galley, ink);
    if tally.wrong > 0 {
        let at = cell.right_top() + vec2(-6.0, 6.0);
        painter.circle(at, 3.5, tokens.warning, Stroke::new(1.0, ink));
    }
}
