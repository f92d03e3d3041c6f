//! A covariance of four errors by hand, and the share of an ellipse.

use nalgebra::{Vector2, matrix, vector};
use pilotage_base::statistics::chi_square_probability;
use pilotage_estimation::filter::Gaussian;

use crate::figure::{FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::NormalDraws;
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Four errors, metres east and north; their mean is zero.
const ERRORS: [[f64; 2]; 4] = [[14.0, 10.0], [-14.0, -10.0], [2.0, -10.0], [-2.0, 10.0]];
/// Standard deviation of either error, metres: that of the four.
const DEVIATION: f64 = 10.0;
const SEED: u64 = 7;
const DRAWN: usize = 400;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "gaussian-by-hand",
    text: include_str!("../../texts/en/gaussian-by-hand.md"),
    controls: &[
        LessonControl::slider("correlation", [-0.95, 0.95], 0.05, 0.6, ""),
        LessonControl::slider("size", [0.5, 3.5], 0.05, 1.0, ""),
    ],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (correlation, size) = (setting.get("correlation"), setting.get("size"));
    let shared = correlation * DEVIATION * DEVIATION;
    let variance = DEVIATION * DEVIATION;
    let belief = Gaussian::new(
        Vector2::zeros(),
        matrix![variance, shared; shared, variance],
    );
    let distance = |point: Vector2<f64>| belief.nees(&point).unwrap_or(f64::MAX);
    let mut draws = NormalDraws::seeded(SEED);
    let points: Vec<_> = (0..DRAWN)
        .map(|_| draws.spread(&belief.covariance))
        .collect();
    let within = points
        .iter()
        .filter(|point| distance(**point) <= size * size);
    let drawn = 100.0 * within.count() as f64 / DRAWN as f64;
    let axis = |sign: f64| DEVIATION * (1.0 + sign * correlation.abs()).sqrt();
    LessonOutcome {
        figure: draw(&belief, size, &points, words),
        values: vec![
            Value::new("variance", by_hand(0, 0), "m²"),
            Value::new("covariance", by_hand(0, 1), "m²"),
            Value::new("ratio", by_hand(0, 1) / by_hand(0, 0), ""),
            Value::new("correlation", correlation, ""),
            Value::new("size", size, ""),
            Value::new("long", axis(1.0), "m"),
            Value::new("short", axis(-1.0), "m"),
            Value::new("along", distance(vector![10.0, 10.0]), ""),
            Value::new("against", distance(vector![10.0, -10.0]), ""),
            Value::new(
                "inside",
                100.0 * chi_square_probability(size * size, 2.0),
                "%",
            ),
            Value::new("drawn", drawn, "%"),
        ],
        checks: vec![Check::between("inside", 95.0, 96.0)],
    }
}

/// Mean of the products of two components of the four errors.
fn by_hand(first: usize, second: usize) -> f64 {
    let products = ERRORS.iter().map(|error| error[first] * error[second]);
    products.sum::<f64>() / ERRORS.len() as f64
}

fn draw(belief: &Gaussian<2>, size: f64, points: &[Vector2<f64>], words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 480.0);
    let corners = [Vector2::zeros(), vector![640.0, 480.0]];
    let (east, north) = (words.get("east"), words.get("north"));
    let plot = FigurePlot::map(&mut svg, corners, Vector2::zeros(), 45.0, [&east, &north]);
    svg.part("points", |svg| {
        for point in points {
            plot.dot(svg, [point.x, point.y], 2.0, "dot");
        }
    });
    svg.part("ellipse", |svg| {
        plot.ellipse(svg, [0.0, 0.0], &belief.covariance, size, "belief");
    });
    svg.part("hand", |svg| {
        for error in ERRORS {
            plot.dot(svg, error, 6.0, "dot-look");
        }
    });
    svg.part("against", |svg| {
        plot.dot(svg, [10.0, -10.0], 6.0, "dot-reckoning");
    });
    svg.part("along", |svg| plot.dot(svg, [10.0, 10.0], 6.0, "dot-truth"));
    plot.key(
        &mut svg,
        &[
            (&words.get("ellipse"), "word-estimate"),
            (&words.get("hand"), "word-look"),
            (&words.get("against"), "word-reckoning"),
            (&words.get("along"), "word-truth"),
            (&words.get("points"), ""),
        ],
    );
    svg
}
