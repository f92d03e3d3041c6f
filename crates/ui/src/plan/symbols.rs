//! Symbols of a route: home, take-off, landing.

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, vec2};

use crate::tokens::Tokens;

/// Draws a house, the mark of home, with an outline that sets it off from what lies below.
pub fn paint_home(painter: &Painter, at: Pos2, below: Color32, tokens: &Tokens) {
    let corners = [
        (0.0, -9.0),
        (9.0, -1.0),
        (6.0, -1.0),
        (6.0, 8.0),
        (-6.0, 8.0),
        (-6.0, -1.0),
        (-9.0, -1.0),
    ];
    let outline: Vec<Pos2> = corners.map(|(x, y)| at + vec2(x, y)).to_vec();
    painter.add(Shape::closed_line(outline.clone(), Stroke::new(4.0, below)));
    let wall = Rect::from_min_max(at + vec2(-6.0, -1.0), at + vec2(6.0, 8.0));
    painter.rect_filled(wall, 0.0, tokens.surface);
    painter.add(Shape::closed_line(outline, Stroke::new(2.0, tokens.accent)));
}

/// Draws a triangle: upwards for a take-off, downwards for a landing.
pub fn paint_triangle(
    painter: &Painter,
    at: Pos2,
    is_upward: bool,
    below: Color32,
    tokens: &Tokens,
) {
    let tip = if is_upward { -1.0 } else { 1.0 };
    let corners = [(0.0, 6.5 * tip), (7.0, -5.5 * tip), (-7.0, -5.5 * tip)];
    let corners = corners.map(|(x, y)| at + vec2(x, y)).to_vec();
    let edge = Stroke::new(1.5, below);
    painter.add(Shape::convex_polygon(corners, tokens.accent, edge));
}
