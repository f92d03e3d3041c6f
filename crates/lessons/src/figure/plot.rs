//! A plot: numbers on two axes, drawn into a part of a figure.

use nalgebra::{Matrix2, Vector2, vector};

use super::axis::Axis;
use super::clip;
use super::svg::{Svg, TextAnchor};

/// Room at the left of a plot for its numbers and words, and below it.
const LEFT: f64 = 56.0;
const BELOW: f64 = 44.0;
/// Room at the right and above.
const RIM: f64 = 14.0;
/// Length between two numbers of an axis.
const BETWEEN: f64 = 80.0;

/// Plot with an axis to the right and one upwards.
#[derive(Clone, Debug, PartialEq)]
pub struct FigurePlot {
    x: Axis,
    y: Axis,
    // The axes' area: its low corner (left, bottom) and its size, both positive.
    origin: Vector2<f64>,
    size: Vector2<f64>,
}

impl FigurePlot {
    /// Plot in the part of a drawing between two corners, its axes drawn.
    pub fn new(svg: &mut Svg, [corner, other]: [Vector2<f64>; 2], x: Axis, y: Axis) -> Self {
        let (low, high) = (corner.inf(&other), corner.sup(&other));
        let origin = vector![low.x + LEFT, high.y - BELOW];
        let size = vector![high.x - RIM, origin.y] - vector![origin.x, low.y + RIM];
        let plot = Self { x, y, origin, size };
        plot.frame(svg);
        plot
    }

    /// Plot over the whole of a drawing.
    pub fn whole(svg: &mut Svg, x: Axis, y: Axis) -> Self {
        let corner = vector![svg.width(), svg.height()];
        Self::new(svg, [Vector2::zeros(), corner], x, y)
    }

    /// Map with metres east to the right and north up, both in the same scale, around `center` (east, north); `reach`
    /// metres up and down.
    pub fn map(
        svg: &mut Svg,
        [corner, other]: [Vector2<f64>; 2],
        center: Vector2<f64>,
        reach: f64,
        [east, north]: [&str; 2],
    ) -> Self {
        let span = (corner - other).abs() - vector![LEFT + RIM, BELOW + RIM];
        let wide = reach * span.x / span.y;
        let axis =
            |middle: f64, half: f64, label: &str| Axis::new([middle - half, middle + half], label);
        let (x, y) = (axis(center.x, wide, east), axis(center.y, reach, north));
        Self::new(svg, [corner, other], x, y)
    }

    /// Map over the whole of a drawing.
    pub fn whole_map(svg: &mut Svg, center: Vector2<f64>, reach: f64, labels: [&str; 2]) -> Self {
        let corner = vector![svg.width(), svg.height()];
        Self::map(svg, [Vector2::zeros(), corner], center, reach, labels)
    }

    /// Place of two numbers in the drawing.
    pub fn at(&self, x: f64, y: f64) -> Vector2<f64> {
        self.origin
            + vector![
                self.x.share(x) * self.size.x,
                -self.y.share(y) * self.size.y
            ]
    }

    /// Length in the drawing of a number along the axis to the right.
    pub fn length(&self, number: f64) -> f64 {
        (number / (self.x.to - self.x.from)).abs() * self.size.x
    }

    /// Line through points; what lies outside is cut off at the rim.
    pub fn line(&self, svg: &mut Svg, points: &[[f64; 2]], class: &str) {
        let points: Vec<_> = points.iter().map(|[x, y]| self.at(*x, *y)).collect();
        for part in clip::line(&points, self.corners()) {
            svg.path(&part, false, class);
        }
    }

    /// Area between two lines over the same numbers, `[x, low, high]`; what lies outside is cut off at the rim.
    pub fn band(&self, svg: &mut Svg, points: &[[f64; 3]], class: &str) {
        let lower = points.iter().map(|[x, low, _]| [*x, *low]);
        let upper = points.iter().rev().map(|[x, _, high]| [*x, *high]);
        let outline: Vec<_> = lower.chain(upper).collect();
        self.area(svg, &outline, class);
    }

    /// Area within an outline; what lies outside of the axes is cut off at the rim.
    pub fn area(&self, svg: &mut Svg, outline: &[[f64; 2]], class: &str) {
        let outline: Vec<_> = outline.iter().map(|[x, y]| self.at(*x, *y)).collect();
        let inside = clip::area(&outline, self.corners());
        if !inside.is_empty() {
            svg.path(&inside, true, class);
        }
    }

    /// Dot at two numbers, if it lies inside.
    pub fn dot(&self, svg: &mut Svg, [x, y]: [f64; 2], radius: f64, class: &str) {
        let inside = |share: f64| (-1e-9..=1.0 + 1e-9).contains(&share);
        if inside(self.x.share(x)) && inside(self.y.share(y)) {
            svg.circle(self.at(x, y), radius, class);
        }
    }

    /// Line at a height, from side to side.
    pub fn level(&self, svg: &mut Svg, y: f64, class: &str) {
        self.line(svg, &[[self.x.from, y], [self.x.to, y]], class);
    }

    /// Ellipse of a covariance in the axes' numbers (x, y), at so many deviations; what lies outside is cut off.
    pub fn ellipse(
        &self,
        svg: &mut Svg,
        [x, y]: [f64; 2],
        covariance: &Matrix2<f64>,
        deviations: f64,
        class: &str,
    ) {
        let scale = Matrix2::from_diagonal(&vector![
            self.size.x / (self.x.to - self.x.from),
            -self.size.y / (self.y.to - self.y.from)
        ]);
        let drawn = scale * covariance * scale;
        let center = self.at(x, y);
        let [low, high] = self.corners();
        let reach = deviations * drawn.diagonal().map(|variance| variance.max(0.0).sqrt());
        let room = (center - low).inf(&(high - center)) - reach;
        let draw = |svg: &mut Svg| svg.ellipse(center, &drawn, deviations, class);
        if room.min() < 0.0 {
            svg.within(low, high, draw);
        } else {
            draw(svg);
        }
    }

    /// Words at two numbers.
    pub fn text(
        &self,
        svg: &mut Svg,
        [x, y]: [f64; 2],
        anchor: TextAnchor,
        class: &str,
        words: &str,
    ) {
        svg.text(self.at(x, y), anchor, class, words);
    }

    /// Words with their classes in a row above the right end of the plot's inside: what the lines are.
    pub fn key(&self, svg: &mut Svg, entries: &[(&str, &str)]) {
        let right = self.origin.x + self.size.x - 6.0;
        let top = self.origin.y - self.size.y + 16.0;
        for (index, (words, class)) in entries.iter().enumerate() {
            svg.text(
                vector![right, top + 17.0 * index as f64],
                TextAnchor::End,
                class,
                words,
            );
        }
    }

    /// Corners of the axes' area in the drawing, top left and bottom right.
    fn corners(&self) -> [Vector2<f64>; 2] {
        let (left, bottom) = (self.origin.x, self.origin.y);
        [
            vector![left, bottom - self.size.y],
            vector![left + self.size.x, bottom],
        ]
    }

    fn frame(&self, svg: &mut Svg) {
        let far = self.origin + vector![self.size.x, -self.size.y];
        let (ticks, decimals) = self.x.ticks((self.size.x / BETWEEN) as usize);
        for tick in ticks {
            let at = self.at(tick, self.y.from);
            svg.line(at, vector![at.x, far.y], "grid");
            let words = format!("{tick:.decimals$}").replace('-', "\u{2212}");
            svg.text(at + vector![0.0, 18.0], TextAnchor::Middle, "small", &words);
        }
        let (ticks, decimals) = self.y.ticks((self.size.y / BETWEEN * 1.4) as usize);
        for tick in ticks {
            let at = self.at(self.x.from, tick);
            svg.line(at, vector![far.x, at.y], "grid");
            let words = format!("{tick:.decimals$}").replace('-', "\u{2212}");
            svg.text(at + vector![-6.0, 4.0], TextAnchor::End, "small", &words);
        }
        let corner = vector![self.origin.x, far.y];
        svg.path(
            &[corner, self.origin, vector![far.x, self.origin.y]],
            false,
            "axis",
        );
        let middle = (self.origin + far) / 2.0;
        svg.text(
            vector![middle.x, self.origin.y + 38.0],
            TextAnchor::Middle,
            "small",
            &self.x.label,
        );
        svg.upright(
            vector![self.origin.x - 42.0, middle.y],
            "small",
            &self.y.label,
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::matrix;

    #[test]
    fn numbers_lie_where_their_axes_say() {
        let mut svg = Svg::new(300.0, 200.0);
        let plot = FigurePlot::whole(
            &mut svg,
            Axis::new([0.0, 10.0], "s"),
            Axis::new([0.0, 1.0], "m"),
        );
        assert_eq!(plot.at(0.0, 0.0), vector![LEFT, 200.0 - BELOW]);
        assert_eq!(plot.at(10.0, 1.0), vector![300.0 - RIM, RIM]);
        assert_eq!(plot.corners(), [plot.at(0.0, 1.0), plot.at(10.0, 0.0)]);
    }

    #[test]
    fn what_leaves_the_axes_is_cut_off_and_not_laid_along_the_rim() {
        let mut svg = Svg::new(300.0, 200.0);
        let plot = FigurePlot::whole(
            &mut svg,
            Axis::new([0.0, 10.0], "s"),
            Axis::new([0.0, 1.0], "m"),
        );
        let mut drawn = Svg::new(300.0, 200.0);
        plot.line(&mut drawn, &[[0.0, 0.5], [5.0, 1.5], [10.0, 1.5]], "truth");
        let (begin, end) = (plot.at(0.0, 0.5), plot.at(2.5, 1.0));
        let wanted = format!("d=\"M{} {}L{} {}\"", begin.x, begin.y, end.x, end.y);
        assert!(drawn.body().contains(&wanted), "{} {wanted}", drawn.body());
        let small = matrix![0.25, 0.0; 0.0, 0.01];
        plot.ellipse(&mut drawn, [5.0, 0.5], &small, 2.0, "belief");
        assert!(!drawn.body().contains("<svg"));
        plot.ellipse(&mut drawn, [5.0, 0.9], &small, 2.0, "belief");
        assert!(
            drawn.body().contains("<svg x=\"56\" y=\"14\""),
            "{}",
            drawn.body()
        );
    }

    #[test]
    fn a_map_has_one_scale() {
        let mut svg = Svg::new(400.0, 200.0);
        let corners = [Vector2::zeros(), vector![400.0, 200.0]];
        let plot = FigurePlot::map(
            &mut svg,
            corners,
            vector![5.0, -3.0],
            50.0,
            ["east", "north"],
        );
        let (a, b, c) = (plot.at(5.0, -3.0), plot.at(15.0, -3.0), plot.at(5.0, 7.0));
        assert!(((b - a).norm() - (c - a).norm()).abs() < 1e-9);
        assert!(c.y < a.y, "north is up");
        let mut drawn = Svg::new(1.0, 1.0);
        plot.ellipse(
            &mut drawn,
            [5.0, -3.0],
            &matrix![4.0, 0.0; 0.0, 4.0],
            1.0,
            "belief",
        );
        let radius = plot.length(2.0);
        assert!(
            drawn
                .body()
                .contains(&format!("rx=\"{}\"", (radius * 100.0).round() / 100.0))
        );
    }
}
