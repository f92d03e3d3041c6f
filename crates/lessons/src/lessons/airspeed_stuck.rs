//! The airspeed's reading freezes: found from innovations ahead and behind.

use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{AIRSPEED, WatchedFlight, draw_symptoms};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Moment from which the pilot flies faster, and the reading does not show it, s; true airspeed then, m/s.
const FASTER: (f64, f64) = (105.0, 27.0);
/// Seconds between looks.
const BETWEEN: f64 = 5.0;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "airspeed-stuck",
    text: include_str!("../../texts/en/airspeed-stuck.md"),
    controls: &[LessonControl::slider("from", [0.0, 300.0], 5.0, 300.0, "s")],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let from = setting.get("from");
    let flight = WatchedFlight {
        faster: Some(FASTER),
        distrusted: from,
        between: BETWEEN,
        ..WatchedFlight::default()
    };
    let flown = flight.fly();
    let nis = flown.consistency();
    let (low, high) = nis.map_or((0.0, 0.0), |nis| (nis.lower_95, nis.upper_95));
    let all = flown.moments.iter();
    let calm: Vec<f64> = all
        .filter(|moment| moment.time > 30.0 && moment.time <= 100.0)
        .map(|moment| moment.deviation)
        .collect();
    LessonOutcome {
        figure: draw_symptoms(&flown, 100.0, 100.0, words),
        values: vec![
            Value::new("from", from, "s"),
            Value::new("ahead", (FASTER.1 - AIRSPEED) * BETWEEN, "m"),
            Value::new("nis", nis.map_or(0.0, |nis| nis.mean), ""),
            Value::new(
                "early",
                calm.iter().sum::<f64>() / calm.len().max(1) as f64,
                "m",
            ),
            Value::new("error", flown.largest_error(30.0), "m"),
        ],
        checks: vec![
            Check::between("nis", low, high),
            Check::at_most("early", 4.0),
        ],
    }
}
