//! Spread and weights of the sigma points: α, β and κ.

use nalgebra::{Matrix1, Vector1, vector};
use pilotage_estimation::filter::{Gaussian, Ukf, UnscentedSettings};

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Wind and its deviation, m/s.
const WIND: (f64, f64) = (10.0, 6.0);
/// Half the density of the air, kg/m³.
const HALF_DENSITY: f64 = 0.6125;
/// Deviation of the heading, radians: 60°.
const HEADING: f64 = std::f64::consts::FRAC_PI_3;
/// Way flown, metres.
const WAY: f64 = 1000.0;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "alpha-beta-kappa",
    text: include_str!("../../texts/en/alpha-beta-kappa.md"),
    controls: &[
        LessonControl::choice("function", 2),
        LessonControl::slider("beta", [0.0, 4.0], 0.5, 0.0, ""),
        LessonControl::slider("alpha", [0.05, 1.0], 0.05, 1.0, ""),
        LessonControl::slider("kappa", [0.0, 3.0], 0.5, 0.0, ""),
    ],
    compute,
};

/// Function of one number through which a belief goes.
struct Bend {
    prior: Gaussian<1>,
    /// Units of the drawing per unit of the number.
    shown: f64,
    map: fn(f64) -> f64,
    /// Mean and deviation behind the function as they are.
    truth: (f64, f64),
    range: [f64; 2],
    axes: [&'static str; 2],
}

/// ½ρv² of a wind: mean and variance of a square of a Gaussian are known.
fn pressure() -> Bend {
    let (mean, deviation) = WIND;
    let variance = deviation * deviation;
    let square = 4.0 * mean * mean * variance + 2.0 * variance * variance;
    Bend {
        prior: Gaussian::from_standard_deviations(Vector1::new(mean), &Vector1::new(deviation)),
        shown: 1.0,
        map: |wind| HALF_DENSITY * wind * wind,
        truth: (
            HALF_DENSITY * (mean * mean + variance),
            HALF_DENSITY * square.sqrt(),
        ),
        range: [-20.0, 520.0],
        axes: ["wind", "pressure"],
    }
}

/// Way to the north on a heading that is north give or take 60°.
fn way() -> Bend {
    let (once, twice) = (
        (-0.5 * HEADING * HEADING).exp(),
        (-2.0 * HEADING * HEADING).exp(),
    );
    let variance = 0.5 * (1.0 + twice) - once * once;
    Bend {
        prior: Gaussian::from_standard_deviations(Vector1::new(0.0), &Vector1::new(HEADING)),
        shown: 1.0_f64.to_degrees(),
        map: |heading| WAY * heading.cos(),
        truth: (WAY * once, WAY * variance.sqrt()),
        range: [-1100.0, 1500.0],
        axes: ["heading", "way"],
    }
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let bend = if setting.chosen("function") == 0 {
        pressure()
    } else {
        way()
    };
    let settings = UnscentedSettings {
        alpha: setting.get("alpha"),
        beta: setting.get("beta"),
        ..UnscentedSettings::default()
    };
    let kappa = setting.get("kappa");
    let sent = Ukf::with_kappa(bend.prior, settings, kappa).and_then(|mut filter| {
        let points = filter.sigma_points();
        let weights = *filter.weights();
        filter.predict(|x| Vector1::new((bend.map)(x[0])), &Matrix1::zeros())?;
        let places: Vec<f64> = points.iter().map(|point| point[0]).collect();
        Ok((filter.state(), weights, places))
    });
    let Ok((after, weights, places)) = sent else {
        // Every setting of the controls is allowed.
        return LessonOutcome {
            figure: Svg::new(640.0, 420.0),
            values: Vec::new(),
            checks: Vec::new(),
        };
    };
    let deviation = after.standard_deviations()[0];
    let (true_mean, true_deviation) = bend.truth;
    LessonOutcome {
        figure: draw(&bend, &after, &places, words),
        values: vec![
            Value::new("eta", weights.eta, ""),
            Value::new("centre", weights.mean_centre, ""),
            Value::new("outer", weights.outer, ""),
            Value::new("mean", after.mean[0], ""),
            Value::new("true-mean", true_mean, ""),
            Value::new("mean-ratio", after.mean[0] / true_mean, ""),
            Value::new("deviation", deviation, ""),
            Value::new("true-deviation", true_deviation, ""),
            Value::new("ratio", deviation / true_deviation, ""),
        ],
        checks: vec![
            Check::between("mean-ratio", 0.98, 1.02),
            Check::between("ratio", 0.98, 1.02),
        ],
    }
}

fn draw(bend: &Bend, after: &Gaussian<1>, places: &[f64], words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 420.0);
    let (mean, deviation) = (bend.prior.mean[0], bend.prior.standard_deviations()[0]);
    let ends = [mean - 2.6 * deviation, mean + 4.0 * deviation].map(|end| end * bend.shown);
    let [x, y] = bend.axes.map(|axis| words.get(axis));
    let plot = FigurePlot::whole(&mut svg, Axis::new(ends, x), Axis::new(bend.range, y));
    let end = mean + 2.6 * deviation;
    svg.part("function", |svg| {
        let from = mean - 2.6 * deviation;
        let curve: Vec<[f64; 2]> = (0..=100)
            .map(|n| from + (end - from) * f64::from(n) / 100.0)
            .map(|x| [x * bend.shown, (bend.map)(x)])
            .collect();
        plot.line(svg, &curve, "axis");
    });
    // Bars at the right: mean and one deviation up and down.
    let bar = |svg: &mut Svg, (mean, spread): (f64, f64), place: f64, class: &str| {
        let x = (end + place * deviation) * bend.shown;
        plot.line(svg, &[[x, mean - spread], [x, mean + spread]], class);
        plot.dot(svg, [x, mean], 5.0, &format!("dot-{class}"));
        let reach = 0.12 * deviation * bend.shown;
        for level in [mean - spread, mean + spread] {
            plot.line(svg, &[[x - reach, level], [x + reach, level]], class);
        }
    };
    svg.part("truth", |svg| bar(svg, bend.truth, 0.4, "truth"));
    let claimed = (after.mean[0], after.standard_deviations()[0]);
    svg.part("claimed", |svg| bar(svg, claimed, 1.0, "estimate"));
    svg.part("points", |svg| {
        for place in places {
            let at = plot.at(place * bend.shown, (bend.map)(*place));
            let foot = plot.at(place * bend.shown, bend.range[0]);
            svg.line(foot, at, "grid");
            svg.circle(at, 6.0, "sigma");
            svg.circle(foot - vector![0.0, 4.0], 4.0, "sigma");
        }
    });
    plot.key(
        &mut svg,
        &[
            (&words.get("truth"), "word-truth"),
            (&words.get("claimed"), "word-estimate"),
            (&words.get("points"), ""),
        ],
    );
    svg
}
