//! Few landmarks are found at night and in snow: nothing is wrong with the filter, and what it says grows.

use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{LOOK, WatchedFlight, draw_symptoms};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Probability that a landmark is found by day, and at night over snow.
const FOUND: [f64; 2] = [0.9, 0.25];
/// With weak answers believed as well: probability of an answer, share of wrong ones, how far they lie off, metres.
const WEAK: (f64, f64, f64) = (0.5, 0.4, 60.0);

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "night-and-snow",
    text: include_str!("../../texts/en/night-and-snow.md"),
    controls: &[
        LessonControl::slider("between", [4.0, 40.0], 2.0, 30.0, "s"),
        LessonControl::choice("answers", 3),
    ],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let between = setting.get("between");
    let (found, wrong) = match setting.chosen("answers") {
        0 => (FOUND[1], (0.0, 0.0)),
        1 => (WEAK.0, (WEAK.1, WEAK.2)),
        _ => (FOUND[0], (0.0, 0.0)),
    };
    let flight = WatchedFlight {
        between,
        found,
        wrong,
        ..WatchedFlight::default()
    };
    let flown = flight.fly();
    let nis = flown.consistency();
    let (low, high) = nis.map_or((0.0, 0.0), |nis| (nis.lower_95, nis.upper_95));
    LessonOutcome {
        figure: draw_symptoms(&flown, 100.0, 200.0, words),
        values: vec![
            Value::new("between", between, "s"),
            Value::new("finds", flown.looks.len() as f64, ""),
            Value::new("likely", 100.0 * found, "%"),
            Value::new("wait", between / found, "s"),
            Value::new("look", LOOK, "m"),
            Value::new("nis", nis.map_or(0.0, |nis| nis.mean), ""),
            Value::new("stated", flown.largest_deviation(30.0), "m"),
            Value::new("error", flown.largest_error(30.0), "m"),
        ],
        checks: vec![
            Check::at_most("likely", 100.0 * FOUND[1]),
            Check::between("nis", low, high),
            Check::at_most("stated", 15.0),
        ],
    }
}
