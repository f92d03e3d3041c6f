//! Aircraft, sigma points, ellipses and the footprint.

use egui::{Color32, Painter, Pos2, Shape, Stroke, Vec2, vec2};
use nalgebra::{DMatrix, Matrix2, SymmetricEigen};
use pilotage_core::frames::GroundPoint;
use pilotage_core::navigator::StepReport;

use super::transform::ScreenFromWorld;
use crate::tokens::Tokens;

/// Draws an aircraft that flies towards `heading` (radians clockwise from north).
pub fn paint_aircraft(
    painter: &Painter,
    view: &ScreenFromWorld,
    at: Pos2,
    heading: f64,
    size: f32,
    fill: Color32,
    edge: Stroke,
) {
    let angle = (heading - view.up) as f32;
    let (sin, cos) = angle.sin_cos();
    let turned = |x: f32, y: f32| {
        let (x, y) = (x * size, y * size);
        at + vec2(x * cos - y * sin, x * sin + y * cos)
    };
    // Outline of the right half from nose to tail; the left half mirrors it.
    let half = [
        (0.0, -1.0),
        (0.14, -0.7),
        (0.16, -0.25),
        (1.0, 0.2),
        (1.0, 0.42),
        (0.16, 0.2),
        (0.12, 0.62),
        (0.42, 0.86),
        (0.42, 1.0),
        (0.0, 0.9),
    ];
    let outline: Vec<Pos2> = half
        .iter()
        .map(|(x, y)| turned(*x, *y))
        .chain(half.iter().rev().map(|(x, y)| turned(-x, *y)))
        .collect();
    // Filled in convex parts, because the outline is not convex.
    for part in [
        vec![
            (0.0, -1.0),
            (0.14, -0.7),
            (0.16, -0.25),
            (0.12, 0.62),
            (0.0, 0.9),
            (-0.12, 0.62),
            (-0.16, -0.25),
            (-0.14, -0.7),
        ],
        vec![(0.0, -0.34), (1.0, 0.2), (1.0, 0.42), (0.0, 0.18)],
        vec![(0.0, -0.34), (0.0, 0.18), (-1.0, 0.42), (-1.0, 0.2)],
        vec![(0.0, 0.56), (0.42, 0.86), (0.42, 1.0), (0.0, 0.9)],
        vec![(0.0, 0.56), (0.0, 0.9), (-0.42, 1.0), (-0.42, 0.86)],
    ] {
        let points = part.into_iter().map(|(x, y)| turned(x, y)).collect();
        painter.add(Shape::convex_polygon(points, fill, Stroke::NONE));
    }
    painter.add(Shape::closed_line(outline, edge));
}

/// Screen points of the ellipse that holds `sigmas` standard deviations, or `None` for a
/// covariance that is not one.
pub fn ellipse(
    view: &ScreenFromWorld,
    center: &GroundPoint,
    covariance: &Matrix2<f64>,
    sigmas: f64,
) -> Option<Vec<Pos2>> {
    if !covariance.iter().all(|v| v.is_finite()) {
        return None;
    }
    let eigen = SymmetricEigen::new(*covariance);
    let axes = eigen.eigenvalues.map(|v| sigmas * v.max(0.0).sqrt());
    let points = (0..64).map(|i| {
        let angle = std::f64::consts::TAU * f64::from(i) / 64.0;
        let offset = eigen.eigenvectors
            * nalgebra::Vector2::new(axes[0] * angle.cos(), axes[1] * angle.sin());
        view.apply(&GroundPoint::new(
            center.north + offset.x,
            center.east + offset.y,
        ))
    });
    Some(points.collect())
}

/// Draws the 1-2-3 σ ellipses of the position.
pub fn paint_ellipses(
    painter: &Painter,
    view: &ScreenFromWorld,
    center: &GroundPoint,
    covariance: &Matrix2<f64>,
    color: Color32,
    tokens: &Tokens,
) {
    for (sigmas, strength) in [(3.0, 0.45), (2.0, 0.7), (1.0, 1.0)] {
        if let Some(points) = ellipse(view, center, covariance, sigmas) {
            if sigmas > 2.5 {
                painter.add(Shape::convex_polygon(
                    points.clone(),
                    color.gamma_multiply(0.10),
                    Stroke::new(2.5, tokens.outline().gamma_multiply(0.35)),
                ));
            }
            let stroke = Stroke::new(1.25, color.gamma_multiply(strength));
            painter.add(Shape::closed_line(points, stroke));
        }
    }
}

/// The sigma points to show for a step: the corrected ones, or the predicted ones.
pub fn sigma_points(step: &StepReport) -> &DMatrix<f64> {
    step.sigma
        .after_correct
        .as_ref()
        .unwrap_or(&step.sigma.after_predict)
}

/// Draws sigma points as white dots with a dark outline.
pub fn paint_sigma(
    painter: &Painter,
    view: &ScreenFromWorld,
    points: &DMatrix<f64>,
    tokens: &Tokens,
    radius: f32,
) {
    if points.nrows() < 2 {
        return;
    }
    for column in points.column_iter() {
        let at = view.apply(&GroundPoint::new(column[0], column[1]));
        painter.circle(at, radius, tokens.sigma, Stroke::new(1.0, tokens.outline()));
    }
}

/// Draws the outline of the picture on the ground, with its top edge marked.
pub fn paint_footprint(
    painter: &Painter,
    view: &ScreenFromWorld,
    outline: &[GroundPoint],
    tokens: &Tokens,
) {
    if outline.len() < 3 {
        return;
    }
    let points: Vec<Pos2> = outline.iter().map(|p| view.apply(p)).collect();
    painter.add(Shape::convex_polygon(
        points.clone(),
        tokens.sigma.gamma_multiply(0.06),
        Stroke::NONE,
    ));
    painter.add(Shape::closed_line(
        points.clone(),
        Stroke::new(3.0, tokens.outline().gamma_multiply(0.4)),
    ));
    painter.add(Shape::closed_line(points, Stroke::new(1.25, tokens.sigma)));
}

/// Draws the outline that the picture would have on the ground with a camera that is tried, dashed, its top edge
/// drawn through.
pub fn paint_tried_footprint(
    painter: &Painter,
    view: &ScreenFromWorld,
    corners: &[GroundPoint],
    tokens: &Tokens,
) {
    let points: Vec<Pos2> = corners.iter().map(|p| view.apply(p)).collect();
    let (Some(first), [left, right, ..]) = (points.first(), points.as_slice()) else {
        return;
    };
    let closed: Vec<Pos2> = points.iter().chain([first]).copied().collect();
    let under = Stroke::new(4.0, tokens.outline().gamma_multiply(0.5));
    painter.add(Shape::line(closed.clone(), under));
    let stroke = Stroke::new(2.0, tokens.observed);
    painter.extend(Shape::dashed_line(&closed, stroke, 7.0, 5.0));
    painter.line_segment([*left, *right], stroke);
}

/// A line with a dark one below it, to be seen on any ground.
pub fn paint_lifted_line(
    painter: &Painter,
    ends: [Pos2; 2],
    width: f32,
    color: Color32,
    tokens: &Tokens,
) {
    painter.line_segment(
        ends,
        Stroke::new(width + 2.0, tokens.outline().gamma_multiply(0.6)),
    );
    painter.line_segment(ends, Stroke::new(width, color));
}

/// Half the length of the lines that mark the middle of a view, points.
const MIDDLE: f32 = 9.0;

/// Marks the middle of a view, which a key takes.
pub fn paint_middle(painter: &Painter, middle: Pos2, tokens: &Tokens) {
    for (width, color) in [(4.0, tokens.outline()), (1.5, tokens.sigma)] {
        for way in [Vec2::new(MIDDLE, 0.0), Vec2::new(0.0, MIDDLE)] {
            painter.line_segment([middle - way, middle + way], (width, color));
        }
    }
}

/// Text with a dark halo, to be read on any ground.
pub fn paint_halo_text(
    painter: &Painter,
    at: Pos2,
    align: egui::Align2,
    text: &str,
    font: egui::FontId,
    color: Color32,
) -> egui::Rect {
    let galley = painter.layout_no_wrap(text.to_owned(), font, color);
    let rect = align.anchor_size(at, galley.size());
    let halo = Color32::from_black_alpha(150);
    painter.rect_filled(halo_rect(rect), 3.0, halo);
    painter.galley(rect.min, galley, color);
    halo_rect(rect)
}

/// Part of the screen that words with a halo cover, by that of the words.
pub fn halo_rect(words: egui::Rect) -> egui::Rect {
    words.expand2(Vec2::new(4.0, 1.0))
}
