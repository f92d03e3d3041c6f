//! Wind carries: the triangle of velocities, and the wind found on turns.

use nalgebra::{Matrix2, SVector, Vector2, vector};
use pilotage_base::frames::{Attitude, GroundPoint};
use pilotage_estimation::filter::{Gaussian, Ukf, UnscentedSettings};
use pilotage_estimation::vehicle::{AirDataBiases, AirplaneWindBias, ControlInput, VehicleModel};

use crate::figure::{FigurePlot, Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::normal_numbers;
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// True airspeed and what the instrument adds to it, m/s.
const AIRSPEED: f64 = 20.0;
const READS_MORE: f64 = 1.5;
/// Seconds from one look to the next, and the deviation of a look, metres.
const BETWEEN: f64 = 5.0;
const LOOK: f64 = 5.0;
/// Seed of the errors of the looks, as the text says it.
const SEED: u64 = 3;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "wind-carries",
    text: include_str!("../../texts/en/wind-carries.md"),
    controls: &[
        LessonControl::slider("turn", [0.0, 180.0], 15.0, 0.0, "°"),
        LessonControl::slider("wind", [0.0, 12.0], 1.0, 6.0, "m/s"),
        LessonControl::slider("leg", [60.0, 300.0], 30.0, 60.0, "s"),
    ],
    compute,
};

/// Flight as it was flown, and what it taught of the wind.
struct Flown {
    /// Places at the looks, north and east.
    way: Vec<Vector2<f64>>,
    /// The wind as the filter has it at the start and at the end, north and east.
    before: Gaussian<2>,
    after: Gaussian<2>,
}

/// The model: air data that may read wrong by a steady amount, in a steady wind.
fn vehicle() -> AirplaneWindBias {
    AirplaneWindBias {
        wind_noise_density: 0.0,
        start_wind_deviation: 5.0,
        biases: AirDataBiases {
            airspeed_bias_noise_density: 0.0,
            heading_bias_noise_density: 0.0,
            start_airspeed_bias_deviation: 2.0,
            start_heading_bias_deviation: 0.01,
        },
        ..AirplaneWindBias::default()
    }
}

fn wind_of(belief: &Gaussian<6>) -> Gaussian<2> {
    belief.marginal::<2, 2>()
}

/// Flies north for `leg` seconds, then turned by `turn` radians for as long, in a wind from the west.
fn fly(turn: f64, wind: f64, leg: f64) -> Option<Flown> {
    let vehicle = vehicle();
    let prior = vehicle.prior(GroundPoint::new(0.0, 0.0), LOOK);
    let before = wind_of(&prior);
    let mut filter = Ukf::new(prior, UnscentedSettings::default()).ok()?;
    let mut numbers = normal_numbers(SEED);
    let mut truth = SVector::<f64, 6>::zeros();
    truth[3] = wind;
    truth[4] = READS_MORE;
    let mut way = vec![vector![0.0, 0.0]];
    let steps = (leg / BETWEEN).round() as usize;
    for index in 0..2 * steps {
        let heading = if index < steps { 0.0 } else { turn };
        let input = ControlInput::new(AIRSPEED + READS_MORE, Attitude::level(heading));
        truth = vehicle.propagate(&truth, &input, BETWEEN);
        let noise = vehicle.process_noise(filter.mean(), &input, BETWEEN);
        filter
            .predict(|x| vehicle.propagate(x, &input, BETWEEN), &noise)
            .ok()?;
        let look_noise = Matrix2::from_diagonal_element(LOOK * LOOK);
        let predicted = filter
            .predict_measurement(|x| Some(vector![x[0], x[1]]), &look_noise)
            .ok()?;
        let error = vector![numbers.next()?, numbers.next()?] * LOOK;
        let place = vector![truth[0], truth[1]];
        filter.correct(&predicted, &(place + error)).ok()?;
        way.push(place);
    }
    let after = wind_of(&filter.state());
    Some(Flown { way, before, after })
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (turn, wind, leg) = (
        setting.get("turn").to_radians(),
        setting.get("wind"),
        setting.get("leg"),
    );
    let mut state = SVector::<f64, 6>::zeros();
    state[3] = wind;
    let input = ControlInput::new(AIRSPEED, Attitude::level(0.0));
    let ground = vehicle()
        .ground_velocity(&state, &input)
        .unwrap_or_default();
    let course = ground.y.atan2(ground.x).to_degrees();
    let flown = fly(turn, wind, leg);
    let (along, longest, error) = flown.as_ref().map_or((f64::NAN, f64::NAN, f64::NAN), |it| {
        let longest = it.after.covariance.symmetric_eigenvalues().max().sqrt();
        let error = (it.after.mean - vector![0.0, wind]).norm();
        (it.after.standard_deviations()[0], longest, error)
    });
    LessonOutcome {
        figure: flown.map_or_else(|| Svg::new(640.0, 400.0), |it| draw(&it, wind, words)),
        values: vec![
            Value::new("wind", wind, "m/s"),
            Value::new("turn", setting.get("turn"), "°"),
            Value::new("ground-speed", ground.norm(), "m/s"),
            Value::new("course", course, "°"),
            Value::new("along", along, "m/s"),
            Value::new("longest", longest, "m/s"),
            Value::new("error", error, "m/s"),
        ],
        checks: vec![Check::at_most("longest", 0.05)],
    }
}

fn draw(flown: &Flown, wind: f64, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 400.0);
    let last = flown.way[flown.way.len() - 1];
    let (low, high) = flown
        .way
        .iter()
        .fold((last, last), |(low, high), at| (low.inf(at), high.sup(at)));
    let middle = (low + high) / 2.0;
    let reach = 0.62 * (high - low).max().max(1000.0);
    let map = FigurePlot::map(
        &mut svg,
        [vector![0.0, 0.0], vector![310.0, 400.0]],
        vector![middle.y, middle.x],
        reach * 1.2,
        [&words.get("east"), &words.get("north")],
    );
    svg.part("way", |svg| {
        let line: Vec<[f64; 2]> = flown.way.iter().map(|at| [at.y, at.x]).collect();
        map.line(svg, &line, "truth");
        for at in &flown.way {
            map.dot(svg, [at.y, at.x], 2.5, "dot-look");
        }
    });
    map.key(
        &mut svg,
        &[
            (&words.get("way"), "word-truth"),
            (&words.get("looks"), "word-look"),
        ],
    );
    let winds = FigurePlot::map(
        &mut svg,
        [vector![330.0, 0.0], vector![640.0, 400.0]],
        vector![2.0, 0.0],
        22.0,
        [&words.get("wind-east"), &words.get("wind-north")],
    );
    // For 95 % of a Gaussian of two numbers.
    let scale = pilotage_base::statistics::chi_square_quantile(0.95, 2.0).sqrt();
    for (belief, class, part) in [
        (&flown.before, "prior", "before"),
        (&flown.after, "belief", "after"),
    ] {
        svg.part(part, |svg| {
            let of = belief.covariance;
            // North and east become up and right.
            let turned = Matrix2::new(of[(1, 1)], of[(0, 1)], of[(0, 1)], of[(0, 0)]);
            winds.ellipse(svg, [belief.mean[1], belief.mean[0]], &turned, scale, class);
        });
    }
    svg.part("wind", |svg| {
        svg.line(winds.at(0.0, 0.0), winds.at(wind, 0.0), "truth");
        winds.dot(svg, [wind, 0.0], 5.0, "dot-truth");
    });
    let mean = [flown.after.mean[1], flown.after.mean[0]];
    winds.dot(&mut svg, mean, 5.0, "dot-estimate");
    for (row, (key, class)) in [
        ("before", "word-reckoning"),
        ("true-wind", "word-truth"),
        ("after", "word-estimate"),
    ]
    .into_iter()
    .enumerate()
    {
        let at = vector![620.0, 30.0 + 17.0 * row as f64];
        svg.text(at, TextAnchor::End, class, &words.get(key));
    }
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn on_a_straight_leg_the_wind_ahead_stays_mixed_with_the_airspeed_s_error() {
        // Known to 5 m/s and 2 m/s apart, and their sum exactly: 5 · 2 / √(5² + 2²) is left.
        let left = 5.0 * 2.0 / 29.0f64.sqrt();
        for leg in [60.0, 300.0] {
            let found = fly(0.0, 6.0, leg).unwrap().after.standard_deviations()[0];
            assert!((found - left).abs() < 0.06, "{found}");
        }
    }
}
