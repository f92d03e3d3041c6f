//! A look at a twin: the culprit is not the look that was refused.

use nalgebra::Vector2;

use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{WatchedFlight, draw_symptoms, gate_of_looks};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Moment of the look at the twin, s, and where it stands beside the landmark, metres north and east.
const TWIN: (f64, [f64; 2]) = (130.0, [-30.0, 40.0]);
/// Stretch without looks before it, s.
const BLIND: [f64; 2] = [72.0, 128.0];
/// Seconds between looks.
const BETWEEN: f64 = 5.0;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "twin-landmark",
    text: include_str!("../../texts/en/twin-landmark.md"),
    controls: &[
        LessonControl::slider("left-out", [115.0, 175.0], 5.0, 115.0, "s"),
        LessonControl::choice("gate", 2),
    ],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let flight = WatchedFlight {
        between: BETWEEN,
        blind: BLIND,
        wind_deviation: 3.0,
        twin: Some((TWIN.0, Vector2::from(TWIN.1))),
        left_out: Some(setting.get("left-out")),
        gated: setting.chosen("gate") == 0,
        ..WatchedFlight::default()
    };
    let flown = flight.fly();
    let at = |time: f64| {
        flown
            .looks
            .iter()
            .find(|look| (look.time - time).abs() < 0.1)
    };
    let nis = |time: f64| at(time).map_or(0.0, |look| look.nis);
    let beyond = flown
        .looks
        .iter()
        .filter(|look| look.nis > gate_of_looks())
        .count();
    LessonOutcome {
        figure: draw_symptoms(&flown, 100.0, 100.0, words),
        values: vec![
            Value::new("left-out", setting.get("left-out"), "s"),
            Value::new("twin", Vector2::from(TWIN.1).norm(), "m"),
            Value::new("gate", gate_of_looks(), ""),
            Value::new("nis-first", nis(130.0), ""),
            Value::new("nis-next", nis(135.0), ""),
            Value::new("beyond", beyond as f64, ""),
            Value::new("error", flown.largest_error(140.0), "m"),
        ],
        checks: vec![Check::at_most("beyond", 0.0), Check::at_most("error", 20.0)],
    }
}
