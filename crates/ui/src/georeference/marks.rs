//! Control points as they are drawn and taken, in the picture and on the map alike.

use egui::{Align2, Painter, Pos2, Stroke, pos2, vec2};

use crate::map::paint_halo_text;
use crate::tokens::Tokens;

/// Largest distance of a point from the pointer at which it is taken, points.
const REACH: f32 = 12.0;

/// Length on screen that the largest residual is drawn with at most, points.
const LONGEST_ARROW: f32 = 60.0;

/// The nearest of `places` within reach of `at`.
pub fn nearest(places: &[Pos2], at: Pos2) -> Option<usize> {
    let near = |(_, p): &(usize, &Pos2)| p.distance(at) <= REACH;
    let all = places.iter().enumerate().filter(near);
    all.min_by(|a, b| a.1.distance(at).total_cmp(&b.1.distance(at)))
        .map(|(index, _)| index)
}

/// Least error that is drawn as an arrow, pixels or metres: what is less is how numbers are rounded.
const LEAST_DRAWN: f32 = 0.01;

/// Times at most that an arrow is longer than its error: errors of a perfect fit do not look like bad ones.
const MOST_TIMES: f32 = 100.0;

/// Screen points per unit at which the largest arrow is well seen, but never drawn smaller than it is, nor so much larger
/// that it misleads; none where there is no error to draw.
pub fn stretch(arrows: &[egui::Vec2], points_per_unit: f32) -> f32 {
    let largest = arrows.iter().map(|a| a.length()).fold(0.0, f32::max);
    if largest < LEAST_DRAWN {
        return 0.0;
    }
    let most = MOST_TIMES * points_per_unit;
    (LONGEST_ARROW / largest).min(most).max(points_per_unit)
}

/// Draws a control point with its number and its residual.
pub fn paint_point(
    painter: &Painter,
    at: Pos2,
    index: usize,
    enabled: bool,
    chosen: bool,
    arrow: Option<egui::Vec2>,
    tokens: &Tokens,
) {
    let color = match (enabled, chosen) {
        (_, true) => tokens.accent,
        (true, false) => Tokens::over_imagery().observed,
        (false, false) => tokens.muted,
    };
    if let Some(arrow) = arrow.filter(|a| a.length() > 1.0) {
        painter.arrow(at, arrow, Stroke::new(3.5, tokens.outline()));
        painter.arrow(at, arrow, Stroke::new(2.0, tokens.corrected));
    }
    let radius = if chosen { 7.0 } else { 5.0 };
    painter.circle_stroke(at, radius, Stroke::new(4.0, tokens.outline()));
    painter.circle_stroke(at, radius, Stroke::new(2.0, color));
    painter.circle_filled(at, 1.5, color);
    if !enabled {
        let arm = vec2(radius, radius);
        painter.line_segment([at - arm, at + arm], Stroke::new(1.5, color));
    }
    let label = pos2(at.x + radius + 3.0, at.y - radius);
    let text = (index + 1).to_string();
    paint_halo_text(
        painter,
        label,
        Align2::LEFT_BOTTOM,
        &text,
        tokens.normal(),
        color,
    );
}

/// Draws a point that is known on this side only.
pub fn paint_pending(painter: &Painter, at: Pos2, tokens: &Tokens) {
    for (from, to) in [
        (vec2(-10.0, 0.0), vec2(10.0, 0.0)),
        (vec2(0.0, -10.0), vec2(0.0, 10.0)),
    ] {
        painter.line_segment([at + from, at + to], Stroke::new(4.0, tokens.outline()));
        painter.line_segment([at + from, at + to], Stroke::new(2.0, tokens.accent));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_drawn_large_enough_to_be_seen_and_rounding_is_none() {
        assert_eq!(stretch(&[vec2(0.5, 0.0), vec2(0.0, 2.0)], 1.0), 30.0);
        assert_eq!(stretch(&[vec2(100.0, 0.0)], 4.0), 4.0);
        assert_eq!(stretch(&[vec2(1e-9, 0.0), vec2(0.0, 3e-5)], 1.0), 0.0);
        assert_eq!(stretch(&[], 1.0), 0.0);
        assert_eq!(stretch(&[vec2(0.05, 0.0)], 0.2), 20.0, "a hundred times");
    }
}
