//! The meaning of a corridor: 95 % at each moment, not all the way.

use nalgebra::{Matrix2, Vector2, matrix, vector};
use pilotage_base::statistics::chi_square_quantile;

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{RouteBelief, SPEED, normal_numbers};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Seconds of a step; steps of the flight of 8 km.
const STEP: f64 = 5.0;
const STEPS: usize = 80;
/// Deviation of a look, of the place at the start (metres) and of the wind there (m/s).
const LOOK: f64 = 5.0;
const START: (f64, f64) = (5.0, 0.5);
/// Flights that are counted, and those of them that are drawn.
const FLIGHTS: usize = 400;
const DRAWN: usize = 30;
/// Seed of their errors, as the text says it.
const SEED: u64 = 21;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "what-a-corridor-means",
    text: include_str!("../../texts/en/what-a-corridor-means.md"),
    controls: &[
        LessonControl::slider("spacing", [0.5, 4.0], 0.5, 2.0, "km"),
        LessonControl::slider("gusts", [1.0, 4.0], 0.5, 1.0, ""),
    ],
    compute,
};

/// Step of the corridor: what was done, and the deviation across the route after it.
struct Moment {
    seconds: f64,
    gain: Option<Vector2<f64>>,
    across: f64,
}

/// The corridor with landmarks every `spacing` metres. The route leads north, so that east is across.
fn predicted(spacing: f64) -> Vec<Moment> {
    let Some(mut belief) = RouteBelief::new(START.0, START.1) else {
        return Vec::new();
    };
    let across = |belief: &RouteBelief| belief.state().standard_deviations()[1];
    let mut found = vec![Moment {
        seconds: 0.0,
        gain: None,
        across: START.0,
    }];
    for index in 1..=STEPS {
        belief.fly(0.0, STEP);
        let seconds = index as f64 * STEP;
        found.push(Moment {
            seconds,
            gain: None,
            across: across(&belief),
        });
        if (seconds * SPEED) % spacing < 1e-6 {
            let gain = belief
                .look(LOOK)
                .map(|gain| vector![gain[(1, 1)], gain[(3, 1)]]);
            found.push(Moment {
                seconds,
                gain,
                across: across(&belief),
            });
        }
    }
    found
}

/// Errors across the route of flights whose unforeseen motions are `gusts` times as large as the filter believes.
///
/// The autopilot holds the estimate on the line, so that the aircraft is beside it by the error of the estimate.
fn flights(moments: &[Moment], gusts: f64) -> Vec<Vec<f64>> {
    let noise = RouteBelief::new(START.0, START.1).map(|belief| belief.noise(0.0, STEP));
    let own = noise.map_or_else(
        Matrix2::zeros,
        |n| matrix![n[(1, 1)], n[(1, 3)]; n[(3, 1)], n[(3, 3)]],
    );
    let root = own
        .cholesky()
        .map_or_else(Matrix2::zeros, |it| it.l() * gusts);
    let mut numbers = normal_numbers(SEED);
    let mut next = || numbers.next().unwrap_or(0.0);
    (0..FLIGHTS)
        .map(|_| {
            let mut error = vector![START.0 * next(), START.1 * next()];
            moments
                .iter()
                .enumerate()
                .map(|(index, moment)| {
                    if let Some(gain) = moment.gain {
                        error -= gain * (error[0] + LOOK * next());
                    } else if index > 0 {
                        error =
                            matrix![1.0, STEP; 0.0, 1.0] * error + root * vector![next(), next()];
                    }
                    error[0]
                })
                .collect()
        })
        .collect()
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (spacing, gusts) = (1000.0 * setting.get("spacing"), setting.get("gusts"));
    // 95 % of a Gaussian of one number.
    let scale = chi_square_quantile(0.95, 1.0).sqrt();
    let moments = predicted(spacing);
    let flights = flights(&moments, gusts);
    let inside =
        |flight: &[f64], index: usize| flight[index].abs() <= scale * moments[index].across;
    let goal = moments.len() - 1;
    let always = |flight: &Vec<f64>| (0..=goal).all(|index| inside(flight, index));
    let percent = |count: usize| 100.0 * count as f64 / FLIGHTS as f64;
    let moments_inside: usize = flights
        .iter()
        .map(|flight| (0..=goal).filter(|index| inside(flight, *index)).count())
        .sum();
    let widest = moments.iter().map(|it| it.across).fold(0.0, f64::max);
    let kept: Vec<bool> = flights.iter().map(always).collect();
    LessonOutcome {
        figure: draw(&moments, &flights, &kept, scale, words),
        values: vec![
            Value::new("spacing", spacing / 1000.0, "km"),
            Value::new("gusts", gusts, ""),
            Value::new("scale", scale, ""),
            Value::new("sigma", widest, "m"),
            Value::new("widest", scale * widest, "m"),
            Value::new("each", percent(moments_inside) / (goal + 1) as f64, "%"),
            Value::new(
                "always",
                percent(kept.iter().filter(|it| **it).count()),
                "%",
            ),
        ],
        checks: vec![Check::at_most("widest", 30.0)],
    }
}

fn draw(moments: &[Moment], flights: &[Vec<f64>], kept: &[bool], scale: f64, words: &Words) -> Svg {
    const REACH: f64 = 260.0;
    let mut svg = Svg::new(640.0, 420.0);
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([0.0, 8.0], words.get("along")),
        Axis::new([-REACH, REACH], words.get("across")),
    );
    let along = |moment: &Moment| moment.seconds * SPEED / 1000.0;
    svg.part("corridor", |svg| {
        let band: Vec<[f64; 3]> = moments
            .iter()
            .map(|it| [along(it), -scale * it.across, scale * it.across])
            .collect();
        plot.band(svg, &band, "belief");
    });
    svg.part("flights", |svg| {
        for (flight, kept) in flights.iter().zip(kept).take(DRAWN) {
            let line: Vec<[f64; 2]> = moments
                .iter()
                .zip(flight)
                .map(|(moment, error)| [along(moment), *error])
                .collect();
            plot.line(svg, &line, if *kept { "axis" } else { "refused" });
        }
    });
    svg.part("landmarks", |svg| {
        for moment in moments.iter().filter(|it| it.gain.is_some()) {
            svg.circle(plot.at(along(moment), 0.0), 5.0, "landmark");
        }
    });
    plot.key(
        &mut svg,
        &[
            (&words.get("corridor"), "word-estimate"),
            (&words.get("inside"), ""),
            (&words.get("outside"), "word-limit"),
            (&words.get("landmark"), "word-look"),
        ],
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_flights_err_as_the_filter_says() {
        let moments = predicted(2000.0);
        let flights = flights(&moments, 1.0);
        for (index, moment) in moments.iter().enumerate().step_by(20) {
            let squares: f64 = flights.iter().map(|it| it[index].powi(2)).sum();
            let ratio = (squares / FLIGHTS as f64).sqrt() / moment.across;
            assert!((ratio - 1.0).abs() < 0.11, "{index}: {ratio}");
        }
    }
}
