//! Pictures and score surfaces in figures.

use nalgebra::{Vector2, vector};
use pilotage_raster::raster::Gray;

use crate::figure::Svg;

/// Draws a picture from a corner on, its pixels `size` wide; grey levels from `dark` to `bright`.
pub fn draw_picture(
    svg: &mut Svg,
    picture: &Gray,
    corner: Vector2<f64>,
    size: f64,
    [dark, bright]: [f64; 2],
) {
    for row in 0..picture.height() {
        for (column, value) in picture.row(row).iter().enumerate() {
            let shade = (f64::from(*value) - dark) / (bright - dark);
            // Twenty shades are enough for an eye, and short in a file.
            let shade = (shade.clamp(0.0, 1.0) * 20.0).round() / 20.0;
            let place = corner + size * vector![column as f64, row as f64];
            svg.pixel(place, size, shade);
        }
    }
}

/// Draws the outline of a box of a picture that is drawn from `corner` on: left, top, width, height in its pixels.
pub fn draw_box(
    svg: &mut Svg,
    corner: Vector2<f64>,
    size: f64,
    [left, top, width, height]: [f64; 4],
    class: &str,
) {
    let at = |x: f64, y: f64| corner + size * vector![x, y];
    let (right, bottom) = (left + width, top + height);
    svg.path(
        &[
            at(left, top),
            at(right, top),
            at(right, bottom),
            at(left, bottom),
        ],
        true,
        class,
    );
}
