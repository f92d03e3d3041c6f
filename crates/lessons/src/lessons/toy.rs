//! Feet and metres: a toy with one slider.

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Metres in a foot, by definition.
const FOOT: f64 = 0.3048;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "toy",
    text: include_str!("../../texts/en/toy.md"),
    controls: &[LessonControl::slider(
        "feet",
        [100.0, 1000.0],
        10.0,
        500.0,
        "ft",
    )],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let feet = setting.get("feet");
    let mut svg = Svg::new(640.0, 400.0);
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([0.0, 1000.0], words.get("feet")),
        Axis::new([0.0, 320.0], words.get("metres")),
    );
    let ends = [plot.at(0.0, 0.0), plot.at(1000.0, 1000.0 * FOOT)];
    svg.part("line", |svg| svg.line(ends[0], ends[1], "limit"));
    svg.part("height", |svg| {
        svg.circle(plot.at(feet, feet * FOOT), 4.0, "dot-estimate");
    });
    LessonOutcome {
        figure: svg,
        values: vec![
            Value::new("feet", feet, "ft"),
            Value::new("metres", feet * FOOT, "m"),
        ],
        checks: vec![Check::between("metres", 298.0, 302.0)],
    }
}
