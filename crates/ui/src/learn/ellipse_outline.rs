//! Ellipse of a covariance inside a figure.

use egui::Pos2;
use nalgebra::{Matrix2, Vector2};

use crate::views::ellipse;

/// Closed outline of a covariance (metres²) around the origin, in points of the screen.
pub(super) fn closed_ellipse(
    covariance: &Matrix2<f64>,
    squared_radius: f64,
    at: impl Fn(Vector2<f64>) -> Pos2,
) -> Vec<Pos2> {
    ellipse::outline(covariance, squared_radius, 64)
        .into_iter()
        .map(at)
        .collect()
}
