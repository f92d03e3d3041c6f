//! A look that comes late, taken for one of now, on a straight way and after a turn.

use std::f64::consts::PI;

use nalgebra::{Matrix2, SVector, Vector2, vector};
use pilotage_base::frames::{Attitude, GroundPoint};
use pilotage_estimation::filter::{Gaussian, Ukf, UnscentedSettings};
use pilotage_estimation::vehicle::{AirplaneWind, ControlInput, VehicleModel};

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{CRUISE, NormalDraws};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

const SEED: u64 = 3;
/// Wind towards the north, m/s.
const WIND: f64 = 2.0;
/// Step, time of the turn and end of the flight, seconds.
const TIMES: [f64; 3] = [0.5, 60.0, 120.0];
/// Seconds between two looks, and their deviation, metres.
const LOOK: (f64, f64) = (5.0, 5.0);
/// Deviation of the place at the start, metres: the first look tells it.
const START: f64 = 50.0;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "late-look",
    text: include_str!("../../texts/en/late-look.md"),
    controls: &[
        LessonControl::slider("lag", [0.0, 2.0], 0.1, 0.5, "s"),
        LessonControl::choice("told", 2),
    ],
    compute,
};

/// Moment of the flight.
struct Moment {
    time: f64,
    /// Estimate less truth along the course, and its deviation, metres.
    error: f64,
    deviation: f64,
    /// NIS of the look, where there was one.
    nis: Option<f64>,
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let lag = setting.get("lag");
    let flown = flown(lag, setting.chosen("told") == 1).unwrap_or_default();
    let straight = || {
        flown
            .iter()
            .filter(|it| (20.0..TIMES[1]).contains(&it.time))
    };
    let behind = -mean(straight().map(|it| it.error));
    let surprise = mean(straight().filter_map(|it| it.nis));
    let turned = flown.iter().filter(|it| it.time > TIMES[1]);
    let after = turned.filter_map(|it| it.nis).take(3).fold(0.0, f64::max);
    let last = flown.iter().rfind(|it| it.time < TIMES[1]);
    LessonOutcome {
        figure: draw(&flown, lag, words),
        values: vec![
            Value::new("lag", lag, "s"),
            Value::new("late", (CRUISE + WIND) * lag, "m"),
            Value::new("behind", behind, "m"),
            Value::new("stated", last.map_or(0.0, |it| it.deviation), "m"),
            Value::new("nis", surprise, ""),
            Value::new("nis-turn", after, ""),
        ],
        checks: vec![
            Check::between("behind", -3.0, 3.0),
            Check::at_least("lag", 0.5),
        ],
    }
}

fn mean(numbers: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = numbers.fold((0.0, 0), |(sum, count), number| (sum + number, count + 1));
    sum / f64::from(count.max(1))
}

/// Place at a time, metres north: to the north, and from the turn on back to the south.
fn place(time: f64) -> f64 {
    let there = (CRUISE + WIND) * time.min(TIMES[1]);
    there - (CRUISE - WIND) * (time - TIMES[1]).max(0.0)
}

/// Flies it; of a filter that is told of the lag the look is compared with where the aircraft was then.
fn flown(lag: f64, told: bool) -> Option<Vec<Moment>> {
    let model = AirplaneWind::default();
    let prior: Gaussian<4> = model.prior(GroundPoint::new(0.0, 0.0), START);
    let mut filter = Ukf::new(prior, UnscentedSettings::default()).ok()?;
    let mut draws = NormalDraws::seeded(SEED);
    let noise = Matrix2::identity() * (LOOK.1 * LOOK.1);
    let every = (LOOK.0 / TIMES[0]).round() as usize;
    let mut moments = Vec::new();
    for step in 1..=(TIMES[2] / TIMES[0]).round() as usize {
        let time = step as f64 * TIMES[0];
        let heading = if time > TIMES[1] { PI } else { 0.0 };
        let input = ControlInput::new(CRUISE, Attitude::level(heading));
        let added = model.process_noise(filter.mean(), &input, TIMES[0]);
        filter
            .predict(|x| model.propagate(x, &input, TIMES[0]), &added)
            .ok()?;
        let mut nis = None;
        if step % every == 0 {
            let seen = vector![place(time - lag), 0.0] + draws.vector() * LOOK.1;
            let then = |x: &SVector<f64, 4>| -> Option<Vector2<f64>> {
                let back = if told { lag } else { 0.0 };
                Some(vector![x[0], x[1]] - model.ground_velocity(x, &input)? * back)
            };
            let expected = filter.predict_measurement(then, &noise).ok()?;
            nis = Some(filter.correct(&expected, &seen).ok()?.nis);
        }
        let along = heading.cos();
        moments.push(Moment {
            time,
            error: (filter.mean()[0] - place(time)) * along,
            deviation: filter.state().standard_deviations()[0],
            nis,
        });
    }
    Some(moments)
}

fn draw(flown: &[Moment], lag: f64, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 400.0);
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([0.0, TIMES[2]], words.get("time")),
        Axis::new([-60.0, 60.0], words.get("error")),
    );
    let band: Vec<[f64; 3]> = flown
        .iter()
        .map(|it| {
            let twice = 2.0 * it.deviation;
            [it.time, it.error - twice, it.error + twice]
        })
        .collect();
    let line: Vec<[f64; 2]> = flown.iter().map(|it| [it.time, it.error]).collect();
    svg.part("truth", |svg| plot.level(svg, 0.0, "truth"));
    svg.part("late", |svg| {
        let [there, back] = [CRUISE + WIND, CRUISE - WIND].map(|speed| -speed * lag);
        plot.line(svg, &[[0.0, there], [TIMES[1], there]], "look");
        plot.line(svg, &[[TIMES[1], back], [TIMES[2], back]], "look");
    });
    svg.part("estimate", |svg| {
        plot.band(svg, &band, "belief");
        plot.line(svg, &line, "estimate");
    });
    svg.part("turn", |svg| {
        plot.line(svg, &[[TIMES[1], -60.0], [TIMES[1], 60.0]], "limit");
    });
    plot.key(
        &mut svg,
        &[
            (&words.get("truth"), "word-truth"),
            (&words.get("estimate"), "word-estimate"),
            (&words.get("late"), "word-look"),
            (&words.get("turn"), "word-limit"),
        ],
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_filter_that_is_told_of_the_lag_is_as_good_as_one_without() {
        let end = |lag, told| {
            let flown = flown(lag, told).unwrap();
            mean(
                flown
                    .iter()
                    .filter(|it| it.time > 30.0 && it.time < 60.0)
                    .map(|it| it.error),
            )
        };
        let (none, late, told) = (end(0.0, false), end(1.0, false), end(1.0, true));
        // 22 m/s for one second.
        assert!((late - none + 22.0).abs() < 1.0, "{late} against {none}");
        assert!((told - none).abs() < 1.0, "{told} against {none}");
    }
}
