//! The height to fly at: good looks that are rare, or poor ones that are many.

use pilotage_raster::camera::CameraModel;

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{RouteBelief, SPEED};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Deviation with which roll and pitch are known, degrees.
const TILT: f64 = 1.0;
/// Deviation with which a landmark is found in the picture, pixels.
const FOUND: f64 = 2.0;
/// Side of a landmark, metres.
const SIDE: f64 = 15.0;
/// Looks after which nothing changes any more.
const LOOKS: usize = 10;
/// Heights, metres.
const HEIGHTS: [f64; 2] = [50.0, 1000.0];

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "how-high-to-fly",
    text: include_str!("../../texts/en/how-high-to-fly.md"),
    controls: &[
        LessonControl::slider("height", HEIGHTS, 50.0, 50.0, "m"),
        LessonControl::slider("landmarks", [0.5, 8.0], 0.5, 2.0, "/km²"),
    ],
    compute,
};

/// Looks from one height, and what is had of them.
#[derive(Clone, Copy)]
struct Looks {
    /// Deviation of one look on each axis, metres.
    deviation: f64,
    /// Width of the ground in view, metres.
    wide: f64,
    /// Metres from one look to the next.
    between: f64,
    /// Root of the mean square of the error between looks, north and east together, metres.
    error: f64,
}

/// The camera of the lesson: 640 × 480 pixels, 60° from left to right.
fn camera() -> CameraModel {
    CameraModel::pinhole(640, 480, 60f64.to_radians())
}

/// Looks from a height over so many landmarks per square metre, as evenly apart as their number has it.
fn looks(height: f64, density: f64) -> Option<Looks> {
    let camera = camera();
    let pixel = height / camera.focal;
    let deviation = (FOUND * pixel).hypot(height * TILT.to_radians());
    let wide = camera.width as f64 * pixel;
    let between = 1.0 / (density * wide);
    let mut belief = RouteBelief::new(deviation, 0.5)?;
    let mut error = 0.0;
    for _ in 0..LOOKS {
        // The mean of the square over the way to the next look, by Simpson's rule.
        let square = |belief: &RouteBelief| belief.error().powi(2);
        let first = square(&belief);
        belief.fly(0.0, 0.5 * between / SPEED);
        let middle = square(&belief);
        belief.fly(0.0, 0.5 * between / SPEED);
        error = ((first + 4.0 * middle + square(&belief)) / 6.0).sqrt();
        belief.look(deviation)?;
    }
    Some(Looks {
        deviation,
        wide,
        between,
        error,
    })
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (height, per_km) = (setting.get("height"), setting.get("landmarks"));
    let density = per_km / 1e6;
    let nothing = Looks {
        deviation: f64::NAN,
        wide: f64::NAN,
        between: f64::NAN,
        error: f64::NAN,
    };
    let own = looks(height, density).unwrap_or(nothing);
    LessonOutcome {
        figure: draw(height, density, words),
        values: vec![
            Value::new("height", height, "m"),
            Value::new("landmarks", per_km, "/km²"),
            Value::new("look", own.deviation, "m"),
            Value::new("wide", own.wide, "m"),
            Value::new("seconds", own.between / SPEED, "s"),
            Value::new("error", own.error, "m"),
            Value::new("side", SIDE * camera().focal / height, "px"),
        ],
        checks: vec![Check::at_most("error", 20.0), Check::at_least("side", 20.0)],
    }
}

fn draw(height: f64, density: f64, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 400.0);
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([0.0, HEIGHTS[1]], words.get("height")),
        Axis::new([0.0, 80.0], words.get("error")),
    );
    let curve: Vec<(f64, Looks)> = (2..=40)
        .map(|index| f64::from(index) * 25.0)
        .filter_map(|at| looks(at, density).map(|it| (at, it)))
        .collect();
    // Where the error is off the plot, the set height is still seen.
    plot.line(&mut svg, &[[height, 0.0], [height, 80.0]], "axis");
    svg.part("look", |svg| {
        let line: Vec<[f64; 2]> = curve
            .iter()
            .map(|(at, it)| [*at, it.deviation * 2.0f64.sqrt()])
            .collect();
        plot.line(svg, &line, "look");
    });
    svg.part("error", |svg| {
        let line: Vec<[f64; 2]> = curve.iter().map(|(at, it)| [*at, it.error]).collect();
        plot.line(svg, &line, "estimate");
        if let Some(own) = looks(height, density) {
            plot.dot(svg, [height, own.error], 6.0, "dot-estimate");
        }
    });
    svg.part("side", |svg| {
        let highest = SIDE * camera().focal / 20.0;
        plot.line(svg, &[[highest, 0.0], [highest, 80.0]], "limit");
    });
    plot.key(
        &mut svg,
        &[
            (&words.get("error-between"), "word-estimate"),
            (&words.get("look"), "word-look"),
            (&words.get("side"), "word-limit"),
        ],
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_is_a_best_height_between_the_ends() {
        let error = |height: f64| looks(height, 2e-6).unwrap().error;
        let best = (1..=20)
            .map(|it| 50.0 * f64::from(it))
            .min_by(|a, b| error(*a).total_cmp(&error(*b)));
        assert!((100.0..900.0).contains(&best.unwrap()), "{best:?}");
    }
}
