//! Without a look the cloud grows: what the airspeed, a steady wind and a wandering wind add.

use nalgebra::{Vector2, matrix, vector};
use pilotage_base::frames::{Attitude, GroundPoint};
use pilotage_estimation::filter::{Gaussian, Ukf, UnscentedSettings};
use pilotage_estimation::vehicle::{AirData, AirplaneWind, ControlInput, VehicleModel};

use crate::figure::{FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{CRUISE, START, noiseless_airplane};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Seconds between two ellipses.
const STEP: f64 = 5.0;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "cloud-grows",
    text: include_str!("../../texts/en/cloud-grows.md"),
    controls: &[
        LessonControl::slider("time", [0.0, 60.0], STEP, 60.0, "s"),
        LessonControl::slider("wind", [0.0, 4.0], 0.5, 2.0, "m/s"),
    ],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (time, wind) = (setting.get("time"), setting.get("wind"));
    let still = noiseless_airplane();
    let whole = AirplaneWind {
        start_wind_deviation: wind,
        ..AirplaneWind::default()
    };
    let air = AirplaneWind {
        air_data: AirData::default(),
        ..still
    };
    let steady = AirplaneWind {
        start_wind_deviation: wind,
        ..still
    };
    let wander = AirplaneWind {
        wind_noise_density: whole.wind_noise_density,
        ..still
    };
    let deviation = |model: AirplaneWind, start: f64| {
        let last = carried(model, start, time).pop().map(|(belief, _)| belief);
        last.map_or([0.0; 2], |belief| {
            let deviations = belief.standard_deviations();
            [deviations[0], deviations[1]]
        })
    };
    let [along, across] = deviation(whole, START);
    LessonOutcome {
        figure: draw(&carried(whole, START, time), words),
        values: vec![
            Value::new("time", time, "s"),
            Value::new("wind", wind, "m/s"),
            Value::new("air", deviation(air, 0.0)[0], "m"),
            Value::new("steady", deviation(steady, 0.0)[0], "m"),
            Value::new("wander", deviation(wander, 0.0)[0], "m"),
            Value::new("along", along, "m"),
            Value::new("across", across, "m"),
        ],
        checks: vec![Check::at_most("along", 30.0), Check::at_least("wind", 0.5)],
    }
}

/// Beliefs at every step until a time, each with its sigma points.
fn carried(model: AirplaneWind, start: f64, time: f64) -> Vec<(Gaussian<4>, Vec<[f64; 2]>)> {
    let input = ControlInput::new(CRUISE, Attitude::level(0.0));
    let prior = model.prior(GroundPoint::new(0.0, 0.0), start);
    let Ok(mut filter) = Ukf::new(prior, UnscentedSettings::default()) else {
        return Vec::new();
    };
    let steps = (time / STEP).round() as usize;
    let mut beliefs = Vec::with_capacity(steps + 1);
    for step in 0..=steps {
        if step > 0 {
            let noise = model.process_noise(filter.mean(), &input, STEP);
            let moved = filter.predict(|x| model.propagate(x, &input, STEP), &noise);
            if moved.is_err() {
                break;
            }
        }
        let points = filter.sigma_points();
        beliefs.push((
            filter.state(),
            points.iter().map(|x| [x[1], x[0]]).collect(),
        ));
    }
    beliefs
}

fn draw(beliefs: &[(Gaussian<4>, Vec<[f64; 2]>)], words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 480.0);
    let corners = [Vector2::zeros(), vector![640.0, 480.0]];
    let (east, north) = (words.get("east"), words.get("north"));
    let plot = FigurePlot::map(
        &mut svg,
        corners,
        vector![0.0, 640.0],
        1060.0,
        [&east, &north],
    );
    let place = |belief: &Gaussian<4>| [belief.mean[1], belief.mean[0]];
    svg.part("way", |svg| {
        let way: Vec<_> = beliefs.iter().map(|(belief, _)| place(belief)).collect();
        plot.line(svg, &way, "reckoning");
    });
    svg.part("cloud", |svg| {
        // Every second one: at the start, after 10 s, after 20 s.
        let last = beliefs.len().saturating_sub(1);
        for (belief, _) in beliefs.iter().skip(last % 2).step_by(2) {
            let p = belief.covariance;
            let drawn = matrix![p[(1, 1)], p[(0, 1)]; p[(1, 0)], p[(0, 0)]];
            plot.ellipse(svg, place(belief), &drawn, 2.0, "prior");
        }
    });
    svg.part("points", |svg| {
        for at in beliefs
            .iter()
            .flat_map(|(_, points)| points)
            .skip(9 * (beliefs.len() - 1))
        {
            svg.circle(plot.at(at[0], at[1]), 4.0, "sigma");
        }
    });
    plot.key(
        &mut svg,
        &[
            (&words.get("way"), "word-reckoning"),
            (&words.get("cloud"), "word-reckoning"),
            (&words.get("points"), ""),
        ],
    );
    svg
}
