//! The forecast of the wind is wrong, and the filter was told to believe it.

use nalgebra::Vector2;

use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{WatchedFlight, draw_symptoms};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// True wind less the forecast, m/s north and east.
const WRONG: [f64; 2] = [-5.0, 6.0];
/// Seconds between looks.
const BETWEEN: f64 = 10.0;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "wrong-wind",
    text: include_str!("../../texts/en/wrong-wind.md"),
    controls: &[
        LessonControl::slider("claimed", [0.25, 8.0], 0.25, 0.25, "m/s"),
        LessonControl::choice("gate", 2),
    ],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let claimed = setting.get("claimed");
    let flight = WatchedFlight {
        wind: Vector2::from(WRONG),
        wind_deviation: claimed,
        between: BETWEEN,
        gated: setting.chosen("gate") == 1,
        ..WatchedFlight::default()
    };
    let flown = flight.fly();
    let nis = flown.consistency();
    let (low, high) = nis.map_or((0.0, 0.0), |nis| (nis.lower_95, nis.upper_95));
    let wrong = Vector2::from(WRONG).norm();
    LessonOutcome {
        figure: draw_symptoms(&flown, 100.0, 100.0, words),
        values: vec![
            Value::new("claimed", claimed, "m/s"),
            Value::new("wrong", wrong, "m/s"),
            Value::new("carried", wrong * BETWEEN, "m"),
            Value::new(
                "first-nis",
                flown.looks.first().map_or(0.0, |look| look.nis),
                "",
            ),
            Value::new("nis", nis.map_or(0.0, |nis| nis.mean), ""),
            Value::new("refused", flown.refused() as f64, ""),
            Value::new("error", flown.largest_error(30.0), "m"),
        ],
        checks: vec![
            Check::between("nis", low, high),
            Check::at_most("error", 25.0),
        ],
    }
}
