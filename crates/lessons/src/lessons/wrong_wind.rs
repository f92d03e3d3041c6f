//! The forecast of the wind is wrong, and the filter was told to believe it.

use nalgebra::Vector2;

use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{WatchedFlight, WatchedRun, draw_symptoms};
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

/// The flight with a forecast that is claimed to be good to so many m/s.
fn fly(claimed: f64, gated: bool) -> WatchedRun {
    let flight = WatchedFlight {
        wind: Vector2::from(WRONG),
        wind_deviation: claimed,
        between: BETWEEN,
        gated,
        ..WatchedFlight::default()
    };
    flight.fly()
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let claimed = setting.get("claimed");
    let flown = fly(claimed, setting.chosen("gate") == 1);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_takes_five_looks_and_a_minute_and_the_next_turn_brings_nothing_back() {
        let flown = fly(0.25, false);
        let beyond_the_plot: Vec<f64> = flown
            .looks
            .iter()
            .filter(|look| look.nis > 20.0)
            .map(|look| look.time)
            .collect();
        assert_eq!(beyond_the_plot, [10.0, 20.0, 30.0, 40.0, 50.0]);
        // Behind and to the right on the first leg, which leads north.
        let first = &flown.looks[..5];
        let is_south_east = |it: &Vector2<f64>| it.x < 0.0 && it.y > 0.0;
        assert!(first.iter().all(|look| is_south_east(&look.innovation)));
        let wind = Vector2::from(WRONG);
        let off = |time: f64| {
            let moment = flown.moments.iter().find(|it| it.time >= time);
            moment.map(|it| (it.wind - wind).norm()).unwrap()
        };
        assert!(
            off(20.0) > 4.0 && off(65.0) < 2.0,
            "{} {}",
            off(20.0),
            off(65.0)
        );
    }
}
