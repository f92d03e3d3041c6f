//! Observability: wind and a wrong airspeed look alike on a straight way, and not after a turn.

use nalgebra::{Matrix2, vector};
use pilotage_base::frames::{Attitude, GroundPoint};
use pilotage_estimation::filter::{Gaussian, Ukf, UnscentedSettings};
use pilotage_estimation::vehicle::{
    AirData, AirDataBiases, AirplaneWindBias, ControlInput, VehicleModel,
};

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{CRUISE, START};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Seconds between two looks, and their deviation, metres.
const LOOK: (f64, f64) = (5.0, 5.0);
/// Length of the flight and the time of the turn, seconds.
const TIMES: (f64, f64) = (180.0, 90.0);

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "wind-on-turns",
    text: include_str!("../../texts/en/wind-on-turns.md"),
    controls: &[
        LessonControl::slider("turn", [0.0, 180.0], 5.0, 0.0, "°"),
        LessonControl::slider("bias", [0.0, 4.0], 0.5, 2.0, "m/s"),
    ],
    compute,
};

/// Moment of the flight: time, and the deviations of the wind north and of the airspeed's bias.
struct Moment {
    time: f64,
    wind: f64,
    bias: f64,
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (turn, bias) = (setting.get("turn"), setting.get("bias"));
    let (moments, last) = flown(turn.to_radians(), bias).unwrap_or_default();
    let before = moments.iter().rfind(|moment| moment.time <= TIMES.1);
    let end = moments.last();
    let p = last.map_or(nalgebra::SMatrix::zeros(), |belief| belief.covariance);
    let both = (p[(2, 2)] * p[(4, 4)]).sqrt();
    let correlation = if both > 0.0 { p[(2, 4)] / both } else { 0.0 };
    let sum = (p[(2, 2)] + p[(4, 4)] - 2.0 * p[(2, 4)]).max(0.0).sqrt();
    LessonOutcome {
        figure: draw(&moments, turn, words),
        values: vec![
            Value::new("turn", turn, "°"),
            Value::new("bias", bias, "m/s"),
            Value::new("wind-before", before.map_or(0.0, |it| it.wind), "m/s"),
            Value::new("wind-after", end.map_or(0.0, |it| it.wind), "m/s"),
            Value::new("bias-after", end.map_or(0.0, |it| it.bias), "m/s"),
            Value::new("correlation", correlation, ""),
            Value::new("ground-speed", sum, "m/s"),
        ],
        checks: vec![
            Check::at_most("wind-after", 0.2),
            Check::at_least("bias", 2.0),
        ],
    }
}

/// Flies north, turns, and flies on; the instruments' biases and the wind stay as they are. The covariance of a linear
/// filter does not depend on what was measured, and this one is nearly linear: every look is where it was expected.
fn flown(turn: f64, bias: f64) -> Option<(Vec<Moment>, Option<Gaussian<6>>)> {
    let model = AirplaneWindBias {
        air_data: AirData::default(),
        wind_noise_density: 0.01,
        start_wind_deviation: 4.0,
        biases: AirDataBiases {
            airspeed_bias_noise_density: 0.0,
            heading_bias_noise_density: 0.0,
            start_airspeed_bias_deviation: bias,
            start_heading_bias_deviation: 0.0,
        },
    };
    let prior = model.prior(GroundPoint::new(0.0, 0.0), START);
    let mut filter = Ukf::new(prior, UnscentedSettings::default()).ok()?;
    let noise = Matrix2::identity() * (LOOK.1 * LOOK.1);
    let mut moments = Vec::new();
    for step in 1..=(TIMES.0 / LOOK.0).round() as usize {
        let time = step as f64 * LOOK.0;
        let heading = if time > TIMES.1 { turn } else { 0.0 };
        let input = ControlInput::new(CRUISE, Attitude::level(heading));
        let added = model.process_noise(filter.mean(), &input, LOOK.0);
        filter
            .predict(|x| model.propagate(x, &input, LOOK.0), &added)
            .ok()?;
        let expected = filter
            .predict_measurement(|x| Some(vector![x[0], x[1]]), &noise)
            .ok()?;
        let seen = expected.mean;
        filter.correct(&expected, &seen).ok()?;
        let deviations = filter.state().standard_deviations();
        moments.push(Moment {
            time,
            wind: deviations[2],
            bias: deviations[4],
        });
    }
    Some((moments, Some(filter.state())))
}

fn draw(moments: &[Moment], turn: f64, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 400.0);
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([0.0, TIMES.0], words.get("time")),
        Axis::new([0.0, 4.0], words.get("deviation")),
    );
    let line = |of: fn(&Moment) -> f64| -> Vec<[f64; 2]> {
        moments
            .iter()
            .map(|moment| [moment.time, of(moment)])
            .collect()
    };
    svg.part("turn", |svg| {
        if turn > 0.0 {
            plot.line(svg, &[[TIMES.1, 0.0], [TIMES.1, 4.0]], "limit");
        }
    });
    svg.part("wind", |svg| {
        plot.line(svg, &line(|it| it.wind), "estimate");
    });
    svg.part("bias", |svg| {
        plot.line(svg, &line(|it| it.bias), "reckoning");
    });
    let turned = words.get("turned");
    let wind = words.get("wind");
    let bias = words.get("bias");
    let mut key = vec![
        (wind.as_str(), "word-estimate"),
        (bias.as_str(), "word-reckoning"),
    ];
    if turn > 0.0 {
        key.push((&turned, "word-limit"));
    }
    plot.key(&mut svg, &key);
    svg
}
