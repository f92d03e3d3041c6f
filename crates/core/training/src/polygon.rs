//! Polygons on the ground as pixels.

use std::ops::Range;

use pilotage_base::frames::GroundPoint;
use pilotage_raster::imagery::Window;

/// Calls `fill` with each row of `window` and each span of its columns whose pixels have their middle in a `polygon`, by
/// the crossings of its edges with the middle of the row.
pub fn for_spans_inside(
    polygon: &[GroundPoint],
    window: &Window,
    fill: &mut dyn FnMut(usize, Range<usize>),
) {
    let corners: Vec<(f64, f64)> = polygon.iter().map(|p| window.pixel_at(p)).collect();
    let rows = corners.iter().map(|corner| corner.1);
    let (top, bottom) = rows.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| {
        (low.min(y), high.max(y))
    });
    let first = top.floor().max(0.0) as usize;
    let last = (bottom.ceil().max(0.0) as usize).min(window.height);
    let mut crossings = Vec::new();
    for row in first..last {
        let y = row as f64 + 0.5;
        crossings.clear();
        for (k, a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % corners.len()];
            if (a.1 <= y) != (b.1 <= y) {
                crossings.push(a.0 + (y - a.1) / (b.1 - a.1) * (b.0 - a.0));
            }
        }
        crossings.sort_by(f64::total_cmp);
        for inside in crossings.chunks_exact(2) {
            let cut = |x: f64| ((x - 0.5).ceil().max(0.0) as usize).min(window.width);
            let (left, right) = (cut(inside[0]), cut(inside[1]));
            if left < right {
                fill(row, left..right);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A notch cuts the middle out of the upper rows; what lies beyond the window is left out.
    #[test]
    fn rows_of_a_notched_polygon_have_two_spans() {
        let window = Window {
            north_edge: 10.0,
            west_edge: 0.0,
            gsd: 1.0,
            width: 8,
            height: 6,
        };
        let corners = [
            (12.0, -3.0),
            (12.0, 2.0),
            (8.0, 2.0),
            (8.0, 5.0),
            (12.0, 5.0),
            (12.0, 7.0),
            (6.6, 7.0),
            (6.6, -3.0),
        ];
        let polygon = corners.map(|(north, east)| GroundPoint::new(north, east));
        let mut spans = Vec::new();
        for_spans_inside(&polygon, &window, &mut |row, columns| {
            spans.push((row, columns));
        });
        let expected = [(0, 0..2), (0, 5..7), (1, 0..2), (1, 5..7), (2, 0..7)];
        assert_eq!(spans, expected);
    }
}
