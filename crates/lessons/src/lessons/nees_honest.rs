//! Honesty: the mean NEES of thirty flights against the noise that the filter believes in.

use pilotage_estimation::filter::{Consistency, mean_interval};
use pilotage_estimation::vehicle::AirplaneWind;

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{LookedFlight, LookedStep};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

const SEED: u64 = 100;
const FLIGHTS: usize = 30;
/// Wander of the wind as it is, m/s/√s.
const REAL: f64 = 0.2;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "nees-honest",
    text: include_str!("../../texts/en/nees-honest.md"),
    controls: &[LessonControl::slider(
        "believed",
        [0.0, 1.0],
        0.02,
        0.08,
        "m/s/√s",
    )],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let believed = setting.get("believed");
    let flights: Vec<_> = (0..FLIGHTS)
        .map(|number| flight(number, believed))
        .collect();
    let mut all = Consistency::default();
    let mut last = Consistency::default();
    let (mut error, mut stated) = (0.0, 0.0);
    for steps in &flights {
        for step in steps {
            all.push(nees(step), 4);
        }
        if let Some(step) = steps.last() {
            last.push(nees(step), 4);
            error += (step.truth[2] - step.belief.mean[2]).powi(2) / FLIGHTS as f64;
            stated += step.belief.covariance[(2, 2)] / FLIGHTS as f64;
        }
    }
    let (low, high) = mean_interval(4.0, FLIGHTS);
    let mean = all
        .summary_of_runs(FLIGHTS)
        .map_or(f64::MAX, |summary| summary.mean);
    let ended = last.summary().map_or(f64::MAX, |summary| summary.mean);
    LessonOutcome {
        figure: draw(&flights, [low, high], words),
        values: vec![
            Value::new("believed", believed, "m/s/√s"),
            Value::new("nees", mean, ""),
            Value::new("ended", ended, ""),
            Value::new("low", low, ""),
            Value::new("high", high, ""),
            Value::new("error", error.sqrt(), "m/s"),
            Value::new("stated", stated.sqrt(), "m/s"),
        ],
        checks: vec![Check::between("nees", low, high)],
    }
}

fn flight(number: usize, believed: f64) -> Vec<LookedStep> {
    let wandering = |density: f64| AirplaneWind {
        wind_noise_density: density,
        start_wind_deviation: 1.0,
        ..AirplaneWind::default()
    };
    let flight = LookedFlight {
        seed: SEED + number as u64,
        real: wandering(REAL),
        believed: wandering(believed),
        step: 5.0,
        steps: 24,
        every: 1,
        blind: [0, 0],
        look: 5.0,
    };
    flight.fly()
}

fn nees(step: &LookedStep) -> f64 {
    step.belief.nees(&step.truth).unwrap_or(f64::MAX)
}

fn draw(flights: &[Vec<LookedStep>], [low, high]: [f64; 2], words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 400.0);
    let most = 20.0;
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([0.0, 120.0], words.get("time")),
        Axis::new([0.0, most], words.get("nees")),
    );
    svg.part("interval", |svg| {
        plot.band(svg, &[[0.0, low, high], [120.0, low, high]], "shade");
        plot.level(svg, 4.0, "limit");
    });
    let steps = flights.iter().map(Vec::len).min().unwrap_or(0);
    let mean: Vec<[f64; 2]> = (0..steps)
        .map(|step| {
            let sum: f64 = flights.iter().map(|flight| nees(&flight[step])).sum();
            [flights[0][step].time, sum / flights.len() as f64]
        })
        .collect();
    svg.part("nees", |svg| plot.line(svg, &mean, "estimate"));
    plot.key(
        &mut svg,
        &[
            (&words.get("mean"), "word-estimate"),
            (&words.get("expected"), "word-limit"),
            (&words.get("interval"), ""),
        ],
    );
    svg
}
