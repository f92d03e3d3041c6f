//! Curves, bands and dots of long series, thinned to the columns of the screen.

use std::ops::Range;

use egui::{Color32, Mesh, Pos2, Shape, Stroke, pos2};

use super::super::chart::ChartAxes;
use super::pyramid::ExtentPyramid;

/// A column of a table, its times, and the factor to the units on screen.
#[derive(Clone, Copy)]
pub(crate) struct TimeCurve<'a> {
    pub times: &'a [f64],
    pub values: &'a ExtentPyramid,
    pub factor: f64,
}

/// Samples of one column of the screen, or one sample where there are fewer samples than columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ColumnSamples {
    /// Screen x.
    pub x: f32,
    /// Least value, in the units on screen.
    pub low: f64,
    /// Greatest value.
    pub high: f64,
}

impl TimeCurve<'_> {
    /// Samples from the last before the left edge to the first beyond the right edge.
    fn visible(&self, axes: &ChartAxes) -> Range<usize> {
        let first = self.times.partition_point(|t| *t < axes.x.0);
        let after = self.times.partition_point(|t| *t <= axes.x.1);
        first.saturating_sub(1)..(after + 1).min(self.values.len())
    }

    /// Least and greatest visible value, in the units on screen.
    pub fn extent(&self, axes: &ChartAxes) -> Option<(f64, f64)> {
        let visible = self.visible(axes);
        let extent = self.values.extent(visible.start, visible.end)?;
        let (a, b) = (
            f64::from(extent.low) * self.factor,
            f64::from(extent.high) * self.factor,
        );
        Some((a.min(b), a.max(b)))
    }

    /// Places to be drawn from left to right; `None` where the curve breaks.
    pub fn places(&self, axes: &ChartAxes) -> Vec<Option<ColumnSamples>> {
        let visible = self.visible(axes);
        let columns = axes.rect.width().ceil().max(1.0) as usize;
        if visible.len() <= 2 * columns {
            return visible
                .map(|i| {
                    let value = f64::from(self.values.get(i)?) * self.factor;
                    Some(ColumnSamples {
                        x: axes.screen_x(self.times[i]),
                        low: value,
                        high: value,
                    })
                })
                .collect();
        }
        let mut places = Vec::with_capacity(columns);
        let mut from = visible.start;
        let mut last_count = visible.len() / columns;
        for column in 0..columns {
            let x = axes.rect.left() + column as f32;
            let until = axes.x_at(x + 1.0);
            let to = first_not_before(self.times, from..visible.end, until, last_count);
            if to > from {
                last_count = to - from;
                places.push(self.values.extent(from, to).map(|extent| {
                    let (a, b) = (
                        f64::from(extent.low) * self.factor,
                        f64::from(extent.high) * self.factor,
                    );
                    ColumnSamples {
                        x: x + 0.5,
                        low: a.min(b),
                        high: a.max(b),
                    }
                }));
                from = to;
            }
        }
        places
    }
}

/// Index of the first time in `range` that is not before `until`, sought around the `guess`-th.
///
/// Columns of evenly spaced samples hold nearly equally many, so that the guess mostly holds and
/// the search costs nothing.
fn first_not_before(times: &[f64], range: Range<usize>, until: f64, guess: usize) -> usize {
    let at = (range.start + guess).min(range.end);
    let (mut low, mut high) = (at, at);
    let mut step = 1;
    if at < range.end && times[at] < until {
        while high < range.end && times[high] < until {
            low = high + 1;
            high = (high + step).min(range.end);
            step *= 2;
        }
    } else {
        while low > range.start && times[low - 1] >= until {
            high = low - 1;
            low = low.saturating_sub(step).max(range.start);
            step *= 2;
        }
    }
    low + times[low..high].partition_point(|t| *t < until)
}

/// Draws a curve as a line; a column with many samples becomes a stroke from least to greatest.
pub(crate) fn line(
    shapes: &mut Vec<Shape>,
    axes: &ChartAxes,
    curve: &TimeCurve<'_>,
    stroke: Stroke,
) {
    for points in polylines(axes, curve) {
        if points.len() > 1 {
            shapes.push(Shape::line(points, stroke));
        } else if let Some(point) = points.first() {
            shapes.push(Shape::circle_filled(*point, stroke.width, stroke.color));
        }
    }
}

/// The same with dashes.
pub(crate) fn dashed(
    shapes: &mut Vec<Shape>,
    axes: &ChartAxes,
    curve: &TimeCurve<'_>,
    stroke: Stroke,
) {
    for points in polylines(axes, curve) {
        shapes.extend(Shape::dashed_line(&points, stroke, 5.0, 4.0));
    }
}

/// Screen points of the unbroken parts of a curve.
pub(crate) fn polylines(axes: &ChartAxes, curve: &TimeCurve<'_>) -> Vec<Vec<Pos2>> {
    let mut lines = vec![Vec::new()];
    for place in curve.places(axes) {
        let Some(place) = place else {
            if lines.last().is_some_and(|l| !l.is_empty()) {
                lines.push(Vec::new());
            }
            continue;
        };
        let Some(points) = lines.last_mut() else {
            continue;
        };
        let (low, high) = (
            pos2(place.x, axes.screen_y(place.low)),
            pos2(place.x, axes.screen_y(place.high)),
        );
        // Enter the column at the end that is nearer, so that the line does not zigzag.
        let from_low = points
            .last()
            .is_none_or(|p: &Pos2| (p.y - low.y).abs() <= (p.y - high.y).abs());
        let (first, second) = if from_low { (low, high) } else { (high, low) };
        points.push(first);
        if (first.y - second.y).abs() > 0.25 {
            points.push(second);
        }
    }
    lines.retain(|l| !l.is_empty());
    lines
}

/// Fills between the least of `low` and the greatest of `high`.
pub(crate) fn band(
    shapes: &mut Vec<Shape>,
    axes: &ChartAxes,
    low: &TimeCurve<'_>,
    high: &TimeCurve<'_>,
    color: Color32,
) {
    let mut mesh = Mesh::default();
    let mut previous = false;
    for (low, high) in low.places(axes).into_iter().zip(high.places(axes)) {
        let (Some(low), Some(high)) = (low, high) else {
            previous = false;
            continue;
        };
        let index = mesh.vertices.len() as u32;
        let y = |v: f64| {
            axes.screen_y(v)
                .clamp(axes.rect.top() - 2.0, axes.rect.bottom() + 2.0)
        };
        mesh.colored_vertex(pos2(low.x, y(low.low.min(high.low))), color);
        mesh.colored_vertex(pos2(low.x, y(high.high.max(low.high))), color);
        if previous {
            mesh.add_triangle(index - 2, index - 1, index);
            mesh.add_triangle(index - 1, index, index + 1);
        }
        previous = true;
    }
    if !mesh.is_empty() {
        shapes.push(Shape::mesh(mesh));
    }
}

/// Marks every sample, or the least and greatest of each column.
pub(crate) fn marks(axes: &ChartAxes, curve: &TimeCurve<'_>, mut mark: impl FnMut(Pos2)) {
    for place in curve.places(axes).into_iter().flatten() {
        let low = pos2(place.x, axes.screen_y(place.low));
        let high = pos2(place.x, axes.screen_y(place.high));
        mark(low);
        if (low.y - high.y).abs() > 1.0 {
            mark(high);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use egui::Rect;

    use super::*;

    fn axes(x: (f64, f64)) -> ChartAxes {
        ChartAxes {
            rect: Rect::from_min_max(pos2(0.0, 0.0), pos2(900.0, 100.0)),
            x,
            y: (-2.0, 2.0),
            log: false,
        }
    }

    fn long(length: usize) -> (Vec<f64>, ExtentPyramid) {
        let times: Vec<f64> = (0..length).map(|i| i as f64 * 0.01).collect();
        let mut values = ExtentPyramid::default();
        for (i, time) in times.iter().enumerate() {
            let spike = if i == length / 3 { 1.7 } else { 0.0 };
            values.push((time.sin() * 0.9) as f32 + spike);
        }
        (times, values)
    }

    #[test]
    fn a_single_spike_among_a_million_samples_stays_visible() {
        let (times, values) = long(1_000_000);
        let curve = TimeCurve {
            times: &times,
            values: &values,
            factor: 1.0,
        };
        let axes = axes((0.0, 10_000.0));
        let places = curve.places(&axes);
        let fastest = (0..50)
            .map(|_| {
                let started = Instant::now();
                std::hint::black_box(curve.places(&axes));
                started.elapsed()
            })
            .min()
            .unwrap();
        println!(
            "1 000 000 samples into {} columns: {} µs",
            places.len(),
            fastest.as_micros()
        );
        assert!(places.len() <= 900);
        let spike_x = axes.screen_x(times[333_333]);
        let column = places
            .iter()
            .flatten()
            .find(|p| (p.x - spike_x).abs() <= 1.0 && p.high > 1.0)
            .expect("the spike is in its column");
        let expected = f64::from(values.get(333_333).unwrap());
        assert!((column.high - expected).abs() < 1e-6);
    }

    #[test]
    fn every_column_holds_exactly_the_extent_of_its_samples() {
        let (times, values) = long(40_000);
        let curve = TimeCurve {
            times: &times,
            values: &values,
            factor: -2.0,
        };
        let axes = axes((50.0, 350.0));
        for place in curve.places(&axes).into_iter().flatten() {
            let range = (f64::from(place.x) - 0.5)..(f64::from(place.x) + 0.5);
            let inside: Vec<f64> = (0..times.len())
                .filter(|i| range.contains(&f64::from(axes.screen_x(times[*i]))))
                .map(|i| -2.0 * f64::from(values.get(i).unwrap()))
                .collect();
            let low = inside.iter().copied().fold(f64::INFINITY, f64::min);
            let high = inside.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            // A sample at the very edge of a column may fall to either side.
            assert!(place.low <= low + 0.03 && place.low >= low - 0.03);
            assert!(place.high >= high - 0.03 && place.high <= high + 0.03);
        }
    }

    #[test]
    fn the_search_around_a_guess_finds_what_a_search_from_scratch_finds() {
        let times: Vec<f64> = (0..200).map(|i| f64::from(i * i / 7)).collect();
        for from in [0, 3, 50, 199] {
            for guess in [0, 1, 7, 400] {
                for until in [-1.0, 0.0, 3.5, 900.0, 5600.0, 1e9] {
                    let expected = from + times[from..].partition_point(|t| *t < until);
                    let found = first_not_before(&times, from..200, until, guess);
                    assert_eq!(found, expected, "{from} {guess} {until}");
                }
            }
        }
    }

    #[test]
    fn few_samples_are_drawn_as_they_are_and_break_at_holes() {
        let times = [0.0, 1.0, 2.0, 3.0];
        let mut values = ExtentPyramid::default();
        for value in [0.5, f32::NAN, 1.0, 1.5] {
            values.push(value);
        }
        let curve = TimeCurve {
            times: &times,
            values: &values,
            factor: 1.0,
        };
        let lines = polylines(&axes((0.0, 3.0)), &curve);
        assert_eq!(lines.iter().map(Vec::len).collect::<Vec<_>>(), vec![1, 2]);
    }
}
