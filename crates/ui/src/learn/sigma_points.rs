//! Sets of sigma points inside a figure.

use egui::{Color32, Painter, Pos2, Stroke};
use nalgebra::{DMatrix, Matrix2};

use super::ellipse_outline::closed_ellipse;

/// Draws a set of sigma points (one a column, north and east first, metres) with the ellipse of its covariance; `at` is
/// the place on the screen of a north and an east.
pub(super) fn sigma_set(
    painter: &Painter,
    points: &DMatrix<f64>,
    covariance: &Matrix2<f64>,
    at: &dyn Fn(f64, f64) -> Pos2,
    color: Color32,
) {
    let (north, east) = (points[(0, 0)], points[(1, 0)]);
    let outline = closed_ellipse(covariance, 1.0, |v| at(north + v.x, east + v.y));
    painter.line(outline, Stroke::new(1.5, color));
    for point in points.column_iter() {
        painter.circle_filled(at(point[0], point[1]), 2.5, color);
    }
}

/// Greatest distance of a point of the set from its centre along an axis.
pub(super) fn reach(points: &DMatrix<f64>) -> f64 {
    let center = points.column(0);
    points
        .column_iter()
        .map(|p| (p[0] - center[0]).abs().max((p[1] - center[1]).abs()))
        .fold(0.0, f64::max)
}
