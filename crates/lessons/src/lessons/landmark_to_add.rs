//! A landmark to add: where one more look helps, and what it is to help.

use nalgebra::vector;

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{RouteBelief, SPEED};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Length of the route, and where it has landmarks, metres.
const LENGTH: f64 = 10_000.0;
const KNOWN: [f64; 3] = [1000.0, 2000.0, 3000.0];
/// Metres of a step.
const STEP: f64 = 100.0;
/// Deviation of a look, metres; that of the place (metres) and of the wind (m/s) at the start.
const LOOK: f64 = 5.0;
const START: (f64, f64) = (5.0, 0.5);

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "landmark-to-add",
    text: include_str!("../../texts/en/landmark-to-add.md"),
    controls: &[
        LessonControl::slider("place", [0.5, 10.0], 0.5, 2.5, "km"),
        LessonControl::slider("found", [10.0, 100.0], 10.0, 100.0, "%"),
    ],
    compute,
};

/// Error of the place, north and east together, after each step: `[metres along, metres of error]`. A landmark of the
/// route gives two, and so does the added one at `place`, whether it is found or not.
fn errors(place: f64, found: bool) -> Vec<[f64; 2]> {
    let Some(mut belief) = RouteBelief::new(START.0, START.1) else {
        return Vec::new();
    };
    let mut errors = vec![[0.0, belief.error()]];
    for index in 1..=(LENGTH / STEP) as usize {
        belief.fly(0.0, STEP / SPEED);
        let along = index as f64 * STEP;
        errors.push([along, belief.error()]);
        let here = |place: f64| (place - along).abs() < 1e-6;
        let looks = KNOWN.map(|known| (known, true));
        for (_, found) in looks
            .iter()
            .chain([&(place, found)])
            .filter(|it| here(it.0))
        {
            if *found {
                belief.look(LOOK);
            }
            errors.push([along, belief.error()]);
        }
    }
    errors
}

/// Error if the added landmark is found with a probability: root of the mean square over found and not.
fn mixed(with: &[[f64; 2]], without: &[[f64; 2]], found: f64) -> Vec<[f64; 2]> {
    with.iter()
        .zip(without)
        .map(|(a, b)| {
            let square = found * a[1] * a[1] + (1.0 - found) * b[1] * b[1];
            [a[0], square.sqrt()]
        })
        .collect()
}

fn worst(errors: &[[f64; 2]]) -> f64 {
    errors.iter().map(|it| it[1]).fold(0.0, f64::max)
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (place, found) = (1000.0 * setting.get("place"), setting.get("found") / 100.0);
    let without = errors(place, false);
    let shown = mixed(&errors(place, true), &without, found);
    let last = |errors: &[[f64; 2]]| errors.last().map_or(f64::NAN, |it| it[1]);
    LessonOutcome {
        figure: draw(&without, &shown, place, words),
        values: vec![
            Value::new("place", place / 1000.0, "km"),
            Value::new("found", 100.0 * found, "%"),
            Value::new("worst-before", worst(&without), "m"),
            Value::new("worst", worst(&shown), "m"),
            Value::new("goal", last(&shown), "m"),
        ],
        checks: vec![
            Check::at_most("worst", 145.0),
            Check::at_most("goal", 120.0),
        ],
    }
}

fn draw(without: &[[f64; 2]], with: &[[f64; 2]], place: f64, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 400.0);
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([0.0, 10.5], words.get("along")),
        Axis::new([0.0, 400.0], words.get("error")),
    );
    let kilometres = |errors: &[[f64; 2]]| -> Vec<[f64; 2]> {
        errors.iter().map(|[x, y]| [x / 1000.0, *y]).collect()
    };
    svg.part("without", |svg| {
        plot.line(svg, &kilometres(without), "reckoning");
    });
    svg.part("with", |svg| {
        plot.line(svg, &kilometres(with), "estimate");
    });
    svg.part("known", |svg| {
        for known in KNOWN {
            svg.circle(plot.at(known / 1000.0, 0.0), 6.0, "landmark");
        }
    });
    svg.part("added", |svg| {
        let at = plot.at(place / 1000.0, 0.0);
        svg.line(at, at - vector![0.0, 40.0], "look");
        svg.circle(at - vector![0.0, 40.0], 7.0, "landmark");
    });
    plot.key(
        &mut svg,
        &[
            (&words.get("without"), "word-reckoning"),
            (&words.get("with"), "word-estimate"),
            (&words.get("added"), "word-look"),
        ],
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_landmark_helps_behind_it_and_not_before_it() {
        let (without, with) = (errors(6000.0, false), errors(6000.0, true));
        assert_eq!(without.len(), with.len());
        for (a, b) in with.iter().zip(&without) {
            assert!(a[1] <= b[1] + 1e-9);
            assert!(a[0] >= 6000.0 || a == b);
        }
    }
}
