//! Tuning: how much the wind is believed to wander, against the error and the NIS.

use pilotage_estimation::filter::Consistency;
use pilotage_estimation::vehicle::AirplaneWind;

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{LookedFlight, LookedStep};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

const SEED: u64 = 31;
/// Wander of the wind as it is, m/s/√s.
const REAL: f64 = 0.2;
/// Least and greatest wind drawn, m/s.
const WINDS: [f64; 2] = [-10.0, 10.0];

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "tuning-noise",
    text: include_str!("../../texts/en/tuning-noise.md"),
    controls: &[LessonControl::slider(
        "believed",
        [0.0, 3.0],
        0.02,
        0.0,
        "m/s/√s",
    )],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let believed = setting.get("believed");
    let steps = flown(believed);
    let mut consistency = Consistency::default();
    for nis in steps.iter().filter_map(|step| step.nis) {
        consistency.push(nis, 2);
    }
    let summary = consistency.summary();
    let (mean, low, high) = summary.map_or((f64::MAX, 0.0, 0.0), |it| {
        (it.mean, it.lower_95, it.upper_95)
    });
    let count = consistency.count() as f64;
    LessonOutcome {
        figure: draw(&steps, words),
        values: vec![
            Value::new("believed", believed, "m/s/√s"),
            Value::new("count", count, ""),
            Value::new("nis", mean, ""),
            Value::new("error", wind_error(&steps), "m/s"),
        ],
        checks: vec![Check::between("nis", low, high)],
    }
}

fn flown(believed: f64) -> Vec<LookedStep> {
    let wandering = |density: f64| AirplaneWind {
        wind_noise_density: density,
        start_wind_deviation: 3.0,
        ..AirplaneWind::default()
    };
    let flight = LookedFlight {
        seed: SEED,
        real: wandering(REAL),
        believed: wandering(believed),
        step: 5.0,
        steps: 60,
        every: 1,
        blind: [0, 0],
        look: 5.0,
    };
    flight.fly()
}

/// Root mean square error of the wind to the north over the flight, m/s.
fn wind_error(steps: &[LookedStep]) -> f64 {
    let errors = steps.iter().map(|step| step.belief.mean[2] - step.truth[2]);
    (errors.map(|error| error * error).sum::<f64>() / steps.len().max(1) as f64).sqrt()
}

fn draw(steps: &[LookedStep], words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 400.0);
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([0.0, 300.0], words.get("time")),
        Axis::new(WINDS, words.get("wind")),
    );
    let band: Vec<[f64; 3]> = steps
        .iter()
        .map(|step| {
            let (mean, twice) = (
                step.belief.mean[2],
                2.0 * step.belief.standard_deviations()[2],
            );
            [step.time, mean - twice, mean + twice]
        })
        .collect();
    let line = |of: fn(&LookedStep) -> f64| -> Vec<[f64; 2]> {
        steps.iter().map(|step| [step.time, of(step)]).collect()
    };
    svg.part("band", |svg| plot.band(svg, &band, "belief"));
    svg.part("truth", |svg| {
        plot.line(svg, &line(|step| step.truth[2]), "truth");
    });
    svg.part("estimate", |svg| {
        plot.line(svg, &line(|step| step.belief.mean[2]), "estimate");
    });
    plot.key(
        &mut svg,
        &[
            (&words.get("truth"), "word-truth"),
            (&words.get("estimate"), "word-estimate"),
        ],
    );
    svg
}
