//! Deviations and confidence: one standard deviation is not 95 %.

use nalgebra::{Matrix2, Rotation2, Vector2, vector};
use pilotage_base::statistics::{chi_square_probability, normal_probability};
use pilotage_estimation::filter::Gaussian;

use crate::figure::{FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::normal_numbers;
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Deviations of the belief along and across its longer axis, metres, and that axis' direction from east.
const DEVIATIONS: [f64; 2] = [20.0, 8.0];
const DIRECTION: f64 = 0.5;
/// Places that are drawn.
const PLACES: usize = 200;
/// Seed of the places, as the text says it.
const SEED: u64 = 5;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "how-well-known",
    text: include_str!("../../texts/en/how-well-known.md"),
    controls: &[
        LessonControl::slider("deviations", [0.5, 4.0], 0.05, 1.0, ""),
        LessonControl::slider("errors", [0.5, 3.0], 0.25, 1.0, ""),
    ],
    compute,
};

/// The belief, east and north, metres.
fn belief() -> Gaussian<2> {
    let turn = Rotation2::new(DIRECTION).into_inner();
    let own = Matrix2::from_diagonal(&Vector2::from(DEVIATIONS).map(|it| it * it));
    Gaussian::new(Vector2::zeros(), turn * own * turn.transpose())
}

/// Places of the aircraft in cases of this belief, if errors are `factor` times as large as it says.
fn places(factor: f64) -> Vec<Vector2<f64>> {
    let turn = Rotation2::new(DIRECTION);
    let mut numbers = normal_numbers(SEED);
    let mut next = || numbers.next().unwrap_or(0.0);
    (0..PLACES)
        .map(|_| turn * vector![DEVIATIONS[0] * next(), DEVIATIONS[1] * next()] * factor)
        .collect()
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (deviations, factor) = (setting.get("deviations"), setting.get("errors"));
    let belief = belief();
    let places = places(factor);
    let inside = |at: &Vector2<f64>| {
        belief
            .nees(at)
            .is_ok_and(|nees| nees <= deviations * deviations)
    };
    let counted = places.iter().filter(|at| inside(at)).count();
    let share = chi_square_probability((deviations / factor).powi(2), 2.0);
    let one = 2.0 * normal_probability(deviations / factor) - 1.0;
    LessonOutcome {
        figure: draw(&belief, &places, deviations, inside, words),
        values: vec![
            Value::new("deviations", deviations, ""),
            Value::new("errors", factor, ""),
            Value::new("share", 100.0 * share, "%"),
            Value::new("one-number", 100.0 * one, "%"),
            Value::new("counted", counted as f64, ""),
            Value::new("half-length", deviations * DEVIATIONS[0], "m"),
        ],
        checks: vec![Check::between("share", 94.5, 95.5)],
    }
}

fn draw(
    belief: &Gaussian<2>,
    places: &[Vector2<f64>],
    deviations: f64,
    inside: impl Fn(&Vector2<f64>) -> bool,
    words: &Words,
) -> Svg {
    // The same for all errors, so that an ellipse does not seem to shrink as they grow.
    const REACH: f64 = 180.0;
    let mut svg = Svg::new(640.0, 440.0);
    let plot = FigurePlot::whole_map(
        &mut svg,
        Vector2::zeros(),
        REACH,
        [&words.get("east"), &words.get("north")],
    );
    svg.part("ellipse", |svg| {
        plot.ellipse(svg, [0.0, 0.0], &belief.covariance, deviations, "belief");
    });
    svg.part("places", |svg| {
        for at in places {
            let class = if inside(at) { "dot-truth" } else { "refused" };
            plot.dot(svg, [at.x, at.y], 2.5, class);
        }
    });
    plot.dot(&mut svg, [0.0, 0.0], 5.0, "dot-estimate");
    plot.key(
        &mut svg,
        &[
            (&words.get("ellipse"), "word-estimate"),
            (&words.get("inside"), "word-truth"),
            (&words.get("outside"), "word-limit"),
        ],
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_belief_has_its_deviations_along_its_axes() {
        let axis = vector![DIRECTION.cos(), DIRECTION.sin()];
        let along = belief().nees(&(axis * DEVIATIONS[0])).unwrap();
        assert!((along - 1.0).abs() < 1e-9);
    }
}
