//! Pictures come late: found from innovations in turns that no wind explains.

use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{AIRSPEED, WatchedFlight, Way, draw_symptoms};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;
use nalgebra::Vector2;

/// Age of the pictures, s.
const LATE: f64 = 1.5;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "camera-late",
    text: include_str!("../../texts/en/camera-late.md"),
    controls: &[
        LessonControl::slider("assumed", [0.0, 3.0], 0.25, 0.0, "s"),
        LessonControl::choice("way", 2),
    ],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let assumed = setting.get("assumed");
    let flight = WatchedFlight {
        way: [Way::Turns, Way::Straight][setting.chosen("way")],
        wind: Vector2::zeros(),
        lag: LATE,
        lag_assumed: assumed,
        ..WatchedFlight::default()
    };
    let flown = flight.fly();
    let nis = flown.consistency();
    let (low, high) = nis.map_or((0.0, 0.0), |nis| (nis.lower_95, nis.upper_95));
    let settled: Vec<f64> = flown
        .moments
        .iter()
        .filter(|moment| moment.time > 200.0)
        .map(|moment| moment.error)
        .collect();
    LessonOutcome {
        figure: draw_symptoms(&flown, 50.0, 50.0, words),
        values: vec![
            Value::new("assumed", assumed, "s"),
            Value::new("behind", AIRSPEED * (LATE - assumed).abs(), "m"),
            Value::new("jump", jump(LATE - assumed), "m"),
            Value::new("nis", nis.map_or(0.0, |nis| nis.mean), ""),
            Value::new(
                "usual-error",
                settled.iter().sum::<f64>() / settled.len().max(1) as f64,
                "m",
            ),
            Value::new("error", flown.largest_error(30.0), "m"),
        ],
        checks: vec![
            Check::between("nis", low, high),
            Check::at_most("error", 15.0),
        ],
    }
}

/// Innovation that a quarter turn leaves when pictures are so many seconds older than assumed, metres: the place
/// behind the aircraft moves from behind its old course to behind its new one.
fn jump(older: f64) -> f64 {
    AIRSPEED * older.abs() * std::f64::consts::SQRT_2
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_turn_moves_the_place_behind_by_the_diagonal_of_a_square() {
        let side = AIRSPEED * 2.0;
        assert!((jump(2.0) - side.hypot(side)).abs() < 1e-12);
    }
}
