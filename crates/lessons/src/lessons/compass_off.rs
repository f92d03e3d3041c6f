//! The compass reads wrong: found from innovations that turn up after turns.

use nalgebra::Vector2;

use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{AIRSPEED, WatchedFlight, Way, draw_symptoms};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Compass reading less the true heading, degrees.
const OFF: f64 = 8.0;
/// Moments before and after the first turn at which the estimated wind is read, s.
const BEFORE_AND_AFTER: [f64; 2] = [70.0, 140.0];

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "compass-off",
    text: include_str!("../../texts/en/compass-off.md"),
    controls: &[
        LessonControl::slider("subtracted", [-12.0, 12.0], 0.5, 0.0, "°"),
        LessonControl::choice("way", 2),
    ],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let subtracted = setting.get("subtracted");
    let flight = WatchedFlight {
        way: [Way::Turns, Way::Straight][setting.chosen("way")],
        wind: Vector2::zeros(),
        compass: OFF.to_radians(),
        compass_assumed: subtracted.to_radians(),
        ..WatchedFlight::default()
    };
    let flown = flight.fly();
    let nis = flown.consistency();
    let (low, high) = nis.map_or((0.0, 0.0), |nis| (nis.lower_95, nis.upper_95));
    let wind = |time: f64| flown.at(time).map_or_else(Vector2::zeros, |it| it.wind);
    let [before, after] = BEFORE_AND_AFTER.map(wind);
    let turns = if flight.way == Way::Turns { 3.0 } else { 0.0 };
    LessonOutcome {
        figure: draw_symptoms(&flown, 50.0, 50.0, words),
        values: vec![
            Value::new("subtracted", subtracted, "°"),
            Value::new("nis", nis.map_or(0.0, |nis| nis.mean), ""),
            Value::new("false-wind", false_wind(OFF - subtracted), "m/s"),
            Value::new("wind-east-before", before.y, "m/s"),
            Value::new("wind-north-after", after.x, "m/s"),
            Value::new("turns", turns, ""),
            Value::new("error", flown.largest_error(30.0), "m"),
        ],
        checks: vec![
            Check::between("nis", low, high),
            Check::at_least("turns", 3.0),
            Check::at_most("error", 20.0),
        ],
    }
}

/// Wind for which a compass that is off by so many degrees is taken on a straight flight, m/s: the distance between
/// two air velocities of the same amount.
fn false_wind(off: f64) -> f64 {
    2.0 * AIRSPEED * (0.5 * off.to_radians()).sin().abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sixth_of_a_turn_is_worth_the_airspeed() {
        assert!((false_wind(60.0) - AIRSPEED).abs() < 1e-12);
    }
}
