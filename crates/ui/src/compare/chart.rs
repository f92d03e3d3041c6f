//! Errors against the reference over time.

use egui::{Align2, Color32, Sense, Stroke, Ui, vec2};

use super::results::ResultRow;
use crate::still::Still;
use crate::tokens::Tokens;
use crate::views::chart::{ChartAxes, dashed};
use crate::views::{TimeAxis, parts};

/// Height of the curves, points.
const HEIGHT: f32 = 140.0;

/// A curve of the chart: errors (metres) at times (seconds).
pub(super) struct ErrorCurve<'a> {
    pub errors: &'a [(f64, f64)],
    /// Greatest of them.
    pub greatest: f64,
    pub colour: Color32,
    pub dash: Option<(f32, f32)>,
}

/// Drawing of the curves, which stands still while the time cursor moves.
#[derive(Default)]
pub(super) struct DrawnCurves(Still<CurvesKey>);

/// Everything on which the drawing depends: number of the comparisons, axes, and looks.
type CurvesKey = (u64, ChartAxes, Vec<(Color32, Option<(f32, f32)>)>);

/// The curves of the rows that could be compared.
pub(super) fn curves<'a>(
    rows: &'a [ResultRow],
    look: impl Fn(&ResultRow) -> (Color32, Option<(f32, f32)>),
) -> Vec<ErrorCurve<'a>> {
    let curve = |row: &'a ResultRow| {
        let found = row.comparison.as_ref()?.as_ref().ok()?;
        let (colour, dash) = look(row);
        Some(ErrorCurve {
            errors: &found.absolute,
            greatest: found.absolute_statistics.greatest,
            colour,
            dash,
        })
    };
    rows.iter().filter_map(curve).collect()
}

/// Draws the chart, with the time cursor and the zero of `clock` if they are of its time; the time under a click. The
/// comparisons were `made` so many times.
pub(super) fn error_chart(
    ui: &mut Ui,
    tokens: &Tokens,
    curves: &[ErrorCurve<'_>],
    (drawn, made): (&mut DrawnCurves, u64),
    (factor, unit): (f64, &str),
    clock: Option<(f64, f64)>,
) -> Option<f64> {
    let size = vec2(
        ui.available_width(),
        HEIGHT + 1.8 * tokens.text_sizes[0] + 4.0,
    );
    let (outer, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    parts::name(&response, format!("Error against the reference, {unit}"));
    let times = curves
        .iter()
        .flat_map(|c| [c.errors.first(), c.errors.last()]);
    let (first, last) = times
        .flatten()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), e| {
            (a.min(e.0), b.max(e.0))
        });
    let greatest = curves.iter().map(|c| c.greatest).fold(0.0, f64::max);
    let mut rect = TimeAxis::curves_rect(outer, tokens);
    rect.set_height(HEIGHT);
    let painter = ui.painter_at(outer);
    painter.rect_filled(rect, 2.0, tokens.background);
    if last <= first || curves.is_empty() {
        let middle = rect.center();
        let words = "Nothing to compare yet.";
        painter.text(
            middle,
            Align2::CENTER_CENTER,
            words,
            parts::small(tokens),
            tokens.muted,
        );
        return None;
    }
    let axes = ChartAxes {
        rect,
        x: (first, last),
        y: (0.0, 1.06 * (factor * greatest).max(1e-3)),
        log: false,
    };
    axes.draw_y(&painter, tokens);
    axes.draw_time(&painter, tokens, clock.map_or(first, |(_, zero)| zero));
    let inside = painter.with_clip_rect(rect);
    let looks = curves.iter().map(|curve| (curve.colour, curve.dash));
    let key = (made, axes, looks.collect());
    drawn.0.paint(&inside, key, |shapes| {
        for curve in curves {
            let points = thinned(curve.errors, &axes, factor);
            let stroke = Stroke::new(1.5, curve.colour);
            shapes.extend(dashed(points, stroke, curve.dash));
        }
    });
    if let Some((cursor, _)) = clock {
        let x = axes.screen_x(cursor);
        inside.vline(x, rect.y_range(), Stroke::new(1.0, tokens.accent));
    }
    let is_pressed = response.clicked() || response.dragged();
    let pointer = response.interact_pointer_pos().filter(|_| is_pressed)?;
    Some(axes.x_at(pointer.x).clamp(first, last))
}

/// The greatest error of each column of the screen: what a chart of errors must not hide.
fn thinned(errors: &[(f64, f64)], axes: &ChartAxes, factor: f64) -> Vec<egui::Pos2> {
    let mut points: Vec<egui::Pos2> = Vec::new();
    let mut column = i64::MIN;
    for (time, error) in errors {
        let at = axes.at(*time, factor * error);
        let own = at.x.floor() as i64;
        match points.last_mut() {
            Some(last) if own == column => last.y = last.y.min(at.y),
            _ => points.push(at),
        }
        column = own;
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Rect, pos2};

    #[test]
    fn the_curves_are_gone_through_once_and_not_in_every_frame() {
        let errors: Vec<(f64, f64)> = (0..1000).map(|i| (f64::from(i), 2.0)).collect();
        let others: Vec<(f64, f64)> = (0..1000).map(|i| (f64::from(i), 1.0)).collect();
        let context = egui::Context::default();
        let mut drawn = DrawnCurves::default();
        let mut curve = |errors: &[(f64, f64)], made| {
            let curves = [ErrorCurve {
                errors,
                greatest: 2.0,
                colour: Color32::RED,
                dash: None,
            }];
            let mut output = context.run_ui(egui::RawInput::default(), |ui| {
                let tokens = Tokens::dark();
                error_chart(ui, &tokens, &curves, (&mut drawn, made), (1.0, "m"), None);
            });
            output.textures_delta.clear();
            let corners = context.tessellate(output.shapes, 1.0).into_iter();
            let of_one = |it: egui::ClippedPrimitive| match it.primitive {
                egui::epaint::Primitive::Mesh(mesh) => mesh.vertices,
                egui::epaint::Primitive::Callback(_) => Vec::new(),
            };
            let red = |corner: &egui::epaint::Vertex| corner.color == Color32::RED;
            let places = corners.flat_map(of_one).filter(red).map(|it| it.pos);
            places.collect::<Vec<_>>()
        };
        let first = curve(&errors, 1);
        assert!(!first.is_empty());
        // The comparisons are those of before: nobody looks at the errors.
        assert_eq!(curve(&others, 1), first);
        assert_ne!(curve(&others, 2), first);
    }

    #[test]
    fn a_brief_jump_is_not_thinned_away() {
        let mut errors: Vec<(f64, f64)> = (0..100_000).map(|i| (f64::from(i), 1.0)).collect();
        errors[31_415].1 = 50.0;
        let axes = ChartAxes {
            rect: Rect::from_min_max(pos2(0.0, 0.0), pos2(300.0, 100.0)),
            x: (0.0, 100_000.0),
            y: (0.0, 100.0),
            log: false,
        };
        let points = thinned(&errors, &axes, 1.0);
        assert!(points.len() <= 301);
        let highest = points.iter().map(|p| p.y).fold(f32::INFINITY, f32::min);
        assert!((highest - 50.0).abs() < 1e-3);
    }
}
