//! A look at a twin: the culprit is not the look that was refused.

use nalgebra::Vector2;

use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{WatchedFlight, WatchedRun, draw_symptoms, gate_of_looks};
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

/// The flight with the look at a moment left out.
fn fly(left_out: f64, gated: bool) -> WatchedRun {
    let flight = WatchedFlight {
        between: BETWEEN,
        blind: BLIND,
        wind_deviation: 3.0,
        twin: Some((TWIN.0, Vector2::from(TWIN.1))),
        left_out: Some(left_out),
        gated,
        ..WatchedFlight::default()
    };
    flight.fly()
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let flown = fly(setting.get("left-out"), setting.chosen("gate") == 0);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_looks_in_a_row_are_refused_right_after_the_twin_passed() {
        let flown = fly(115.0, true);
        let refused = flown.looks.iter().filter(|look| !look.accepted);
        let refused: Vec<f64> = refused.map(|look| look.time).collect();
        let ten: Vec<f64> = (1..=10).map(|k| TWIN.0 + BETWEEN * f64::from(k)).collect();
        assert_eq!(refused, ten);
        // Leaving out a look that does not happen changes nothing.
        assert!([120.0, 125.0].iter().all(|time| fly(*time, true) == flown));
    }
}
