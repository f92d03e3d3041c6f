//! Dead reckoning drifts: what grows with the root of the time and what with the time.

use nalgebra::{Vector4, vector};
use pilotage_base::frames::{Attitude, GroundPoint};
use pilotage_estimation::filter::{Ukf, UnscentedSettings};
use pilotage_estimation::vehicle::{AirplaneWind, ControlInput, VehicleModel};

use crate::figure::{Axis, FigurePlot, Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::normal_numbers;
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Airspeed, m/s; the nose points north.
const AIRSPEED: f64 = 20.0;
/// Length of a step, seconds, and how many there are in ten minutes.
const STEP: f64 = 10.0;
const STEPS: usize = 60;
/// Flights that are drawn.
const FLIGHTS: usize = 12;
/// Seed of their errors, as the text says it.
const SEED: u64 = 11;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "dead-reckoning-drifts",
    text: include_str!("../../texts/en/dead-reckoning-drifts.md"),
    controls: &[
        LessonControl::slider("minutes", [1.0, 10.0], 1.0, 4.0, "min"),
        LessonControl::slider("wind", [0.0, 2.0], 0.1, 0.5, "m/s"),
        LessonControl::slider("compass", [0.0, 10.0], 0.5, 0.0, "°"),
    ],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (minutes, wind, compass) = (
        setting.get("minutes"),
        setting.get("wind"),
        setting.get("compass").to_radians(),
    );
    let stated = stated(wind);
    let at = ((60.0 * minutes / STEP).round() as usize).min(STEPS);
    let turned = AIRSPEED * compass.sin();
    let noise = stated_by_noise(60.0 * minutes);
    LessonOutcome {
        figure: draw(&stated, wind, turned, minutes, words),
        values: vec![
            Value::new("minutes", minutes, "min"),
            Value::new("wind", wind, "m/s"),
            Value::new("stated", stated[at], "m"),
            Value::new("by-wind", wind * 60.0 * minutes, "m"),
            Value::new("by-noise", noise, "m"),
            Value::new("turned", turned * 60.0 * minutes, "m"),
        ],
        checks: vec![Check::at_most("stated", 50.0)],
    }
}

/// The airplane's model with a steady wind that is known to `wind` m/s.
fn vehicle(wind: f64) -> AirplaneWind {
    AirplaneWind {
        start_wind_deviation: wind,
        wind_noise_density: 0.0,
        ..AirplaneWind::default()
    }
}

/// Deviation of the place across the heading, metres, after each step without a look, as the filter states it.
fn stated(wind: f64) -> Vec<f64> {
    let vehicle = vehicle(wind);
    let input = ControlInput::new(AIRSPEED, Attitude::level(0.0));
    let prior = vehicle.prior(GroundPoint::new(0.0, 0.0), 0.0);
    let Ok(mut filter) = Ukf::new(prior, UnscentedSettings::default()) else {
        return vec![0.0; STEPS + 1];
    };
    let noise = vehicle.process_noise(&Vector4::zeros(), &input, STEP);
    let mut found = vec![0.0];
    for _ in 0..STEPS {
        let moved = filter.predict(|x| vehicle.propagate(x, &input, STEP), &noise);
        let last = found[found.len() - 1];
        found.push(moved.map_or(last, |it| it.after.standard_deviations()[1]));
    }
    found
}

/// Deviation across the heading that the noise of the instruments alone leaves after `seconds`, metres.
fn stated_by_noise(seconds: f64) -> f64 {
    let input = ControlInput::new(AIRSPEED, Attitude::level(0.0));
    let noise = vehicle(0.0).process_noise(&Vector4::zeros(), &input, seconds);
    noise[(1, 1)].sqrt()
}

/// Errors of flights across the heading, metres, step by step.
fn flights(wind: f64, turned: f64) -> Vec<Vec<f64>> {
    let mut numbers = normal_numbers(SEED);
    let mut next = || numbers.next().unwrap_or(0.0);
    let step = stated_by_noise(STEP);
    (0..FLIGHTS)
        .map(|_| {
            let steady = wind * next() + turned;
            let mut error = 0.0;
            let moved = (0..STEPS).map(|_| {
                error += steady * STEP + step * next();
                error
            });
            std::iter::once(0.0).chain(moved).collect()
        })
        .collect()
}

fn draw(stated: &[f64], wind: f64, turned: f64, minutes: f64, words: &Words) -> Svg {
    const REACH: f64 = 800.0;
    let mut svg = Svg::new(640.0, 420.0);
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([0.0, 10.0], words.get("time")),
        Axis::new([-REACH, REACH], words.get("across")),
    );
    let time = |index: usize| index as f64 * STEP / 60.0;
    svg.part("stated", |svg| {
        for deviations in [2.0, 1.0] {
            let band: Vec<[f64; 3]> = stated
                .iter()
                .enumerate()
                .map(|(index, one)| [time(index), -deviations * one, deviations * one])
                .collect();
            plot.band(svg, &band, "prior");
        }
    });
    svg.part("flights", |svg| {
        for flight in flights(wind, turned) {
            let line: Vec<[f64; 2]> = flight
                .iter()
                .enumerate()
                .map(|(index, error)| [time(index), *error])
                .collect();
            plot.line(svg, &line, "axis");
        }
    });
    svg.part("turned", |svg| {
        let far = if turned > 0.0 {
            (REACH / turned / 60.0).min(10.0)
        } else {
            10.0
        };
        plot.line(svg, &[[0.0, 0.0], [far, turned * 60.0 * far]], "estimate");
    });
    let index = ((60.0 * minutes / STEP).round() as usize).min(STEPS);
    let ends = [-2.0, 2.0].map(|side| [minutes, side * stated[index].max(40.0)]);
    plot.line(&mut svg, &ends, "limit");
    // Flights that a turned compass carries off leave this corner free.
    for (row, (key, class)) in [
        ("stated", "word-reckoning"),
        ("flights", ""),
        ("turned", "word-estimate"),
        ("now", "word-limit"),
    ]
    .into_iter()
    .enumerate()
    {
        let at = plot.at(0.15, -0.68 * REACH) + vector![0.0, 17.0 * row as f64];
        svg.text(at, TextAnchor::Start, class, &words.get(key));
    }
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wind_taken_wrong_grows_with_the_time_and_noise_with_its_root() {
        // 0.5 m/s for 240 s, beside √(0.2² + 0.05²) m/√s.
        let wanted = (120.0f64.powi(2) + 0.0425 * 240.0).sqrt();
        assert!((stated(0.5)[24] - wanted).abs() < 1e-6);
        assert!((stated(0.0)[40] / stated(0.0)[10] - 2.0).abs() < 1e-9);
    }
}
