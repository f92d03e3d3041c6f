//! Figure of a landmark that was found: expected place, gate and found place.

use egui::{Align2, Pos2, Shape, Stroke, vec2};
use nalgebra::Vector2;

use super::figure::Figure;
use crate::views::parts::{self, figures};
use crate::views::{ellipse, picking};

/// Draws expected place, gate, and where the landmark of the moment was found, pixels.
pub(super) fn draw(figure: &Figure<'_>) {
    let Figure {
        painter,
        rect,
        tokens,
        run,
        step,
        moment,
        ..
    } = *figure;
    let candidate = step
        .frame
        .iter()
        .flat_map(|f| &f.candidates)
        .find(|c| Some(c.landmark) == moment.landmark);
    let Some(candidate) = candidate else { return };
    let gate = ellipse::outline(&candidate.innovation_covariance, candidate.threshold, 64);
    let reach = gate
        .iter()
        .copied()
        .chain(candidate.innovation)
        .map(|v| v.amax())
        .fold(1.0, f64::max);
    let scale = f64::from(0.45 * rect.height()) / reach;
    let center = rect.center() + vec2(0.18 * rect.width(), 0.0);
    let at = |v: Vector2<f64>| center + vec2((v.x * scale) as f32, (v.y * scale) as f32);
    let outline: Vec<Pos2> = gate.into_iter().map(at).collect();
    painter.add(Shape::convex_polygon(
        outline.clone(),
        parts::ink(tokens).gamma_multiply(0.08),
        Stroke::NONE,
    ));
    painter.line(outline, Stroke::new(1.0, parts::ink(tokens)));
    painter.circle_stroke(center, 6.0, Stroke::new(1.5, parts::ink(tokens)));
    if let Some(innovation) = candidate.innovation {
        let tip = at(innovation);
        painter.line_segment([center, tip], Stroke::new(1.5, tokens.observed));
        painter.circle_filled(tip, 5.0, tokens.observed);
    }
    let name = picking::landmark_name(run, candidate.landmark);
    let widest =
        candidate.threshold.sqrt() * ellipse::largest_sigma(&candidate.innovation_covariance);
    let size = format!("gate: up to {} px", figures(widest));
    figure.key(&[
        ("expected", parts::ink(tokens)),
        (&format!("{name} found"), tokens.observed),
    ]);
    figure.caption(
        rect.left_bottom() + vec2(tokens.space, -0.75 * tokens.space),
        Align2::LEFT_BOTTOM,
        &size,
        tokens.muted,
    );
}
