//! A Gaussian through a bent function: by slopes, by sigma points, by particles, and truly.

use nalgebra::{Matrix2, Vector2, matrix, vector};
use pilotage_estimation::filter::{
    Ekf, Gaussian, ParticleFilter, ParticleSettings, Ukf, UnscentedSettings, numerical_jacobian,
};

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::NormalDraws;
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Way flown and its deviation, metres.
const WAY: (f64, f64) = (1000.0, 20.0);
const SEED: u64 = 11;
const DRAWN: usize = 300;
const PARTICLES: usize = 1500;

/// Deviation of the heading from which on some fly south, radians.
const WIDE: f64 = 0.5;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "bent-function",
    text: include_str!("../../texts/en/bent-function.md"),
    controls: &[
        LessonControl::slider("heading", [1.0, 60.0], 1.0, 20.0, "°"),
        LessonControl::choice("filter", 3),
    ],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let angle = setting.get("heading").to_radians();
    let deviations = vector![WAY.1, angle];
    let prior = Gaussian::from_standard_deviations(vector![WAY.0, 0.0], &deviations);
    let claimed = match setting.chosen("filter") {
        0 => by_slopes(prior),
        1 => by_sigma_points(prior),
        _ => by_particles(prior),
    };
    let claimed = claimed.unwrap_or(prior);
    let truth = truly(angle);
    let [north, true_north] = [claimed, truth].map(|belief| belief.standard_deviations()[0]);
    LessonOutcome {
        figure: draw(prior, &claimed, &truth, words),
        values: vec![
            Value::new("heading", setting.get("heading"), "°"),
            Value::new("mean", claimed.mean[0], "m"),
            Value::new("true-mean", truth.mean[0], "m"),
            Value::new("off", (claimed.mean - truth.mean).norm(), "m"),
            Value::new("deviation", north, "m"),
            Value::new("true-deviation", true_north, "m"),
            Value::new("ratio", north / true_north, ""),
        ],
        checks: vec![
            Check::at_most("off", 5.0),
            Check::between("ratio", 0.7, 1.4),
            Check::at_least("heading", 20.0),
        ],
    }
}

/// Place, metres north and east, after a way flown on a heading.
fn place(state: &Vector2<f64>) -> Vector2<f64> {
    vector![state.x * state.y.cos(), state.x * state.y.sin()]
}

fn by_slopes(prior: Gaussian<2>) -> Option<Gaussian<2>> {
    let mut filter = Ekf::new(prior, UnscentedSettings::default()).ok()?;
    let slopes = numerical_jacobian(|x| Some(place(x)), &prior.mean)?;
    filter
        .predict(place(&prior.mean), &slopes, &Matrix2::zeros())
        .ok()?;
    Some(filter.state())
}

fn by_sigma_points(prior: Gaussian<2>) -> Option<Gaussian<2>> {
    let mut filter = Ukf::new(prior, UnscentedSettings::default()).ok()?;
    filter.predict(place, &Matrix2::zeros()).ok()?;
    Some(filter.state())
}

fn by_particles(prior: Gaussian<2>) -> Option<Gaussian<2>> {
    let settings = ParticleSettings {
        count: PARTICLES,
        seed: SEED,
        ..ParticleSettings::default()
    };
    let mut filter = ParticleFilter::new(&prior, settings, UnscentedSettings::default()).ok()?;
    filter.predict(place, &Matrix2::zeros()).ok()?;
    Some(*filter.state())
}

/// Mean and covariance as they are: those of a Gaussian's cosine and sine are known in closed form.
fn truly(angle: f64) -> Gaussian<2> {
    let square = WAY.0 * WAY.0 + WAY.1 * WAY.1;
    let (once, twice) = ((-0.5 * angle * angle).exp(), (-2.0 * angle * angle).exp());
    let mean = vector![WAY.0 * once, 0.0];
    let north = 0.5 * square * (1.0 + twice) - mean.x * mean.x;
    Gaussian::new(mean, matrix![north, 0.0; 0.0, 0.5 * square * (1.0 - twice)])
}

fn draw(prior: Gaussian<2>, claimed: &Gaussian<2>, truth: &Gaussian<2>, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 420.0);
    // Who flies south of the start by mistake comes into the picture only where some do.
    let south = if prior.covariance[(1, 1)].sqrt() > WIDE {
        -1100.0
    } else {
        -100.0
    };
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([-1250.0, 1250.0], words.get("east")),
        Axis::new([south, 1500.0], words.get("north")),
    );
    let mut draws = NormalDraws::seeded(SEED);
    svg.part("points", |svg| {
        for _ in 0..DRAWN {
            let at = place(&(prior.mean + draws.spread(&prior.covariance)));
            plot.dot(svg, [at.y, at.x], 1.8, "dot");
        }
    });
    // North and east of the belief become up and right of the plot.
    let turned = |belief: &Gaussian<2>| {
        let p = belief.covariance;
        matrix![p[(1, 1)], p[(1, 0)]; p[(0, 1)], p[(0, 0)]]
    };
    svg.part("truth", |svg| {
        let middle = [truth.mean[1], truth.mean[0]];
        plot.ellipse(svg, middle, &turned(truth), 2.0, "truth");
        plot.dot(svg, middle, 5.0, "dot-truth");
    });
    svg.part("claimed", |svg| {
        let middle = [claimed.mean[1], claimed.mean[0]];
        plot.ellipse(svg, middle, &turned(claimed), 2.0, "belief");
        plot.dot(svg, middle, 4.0, "dot-estimate");
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_truth_in_closed_form_is_that_of_many_draws() {
        let angle = 0.5;
        let prior = Gaussian::from_standard_deviations(vector![WAY.0, 0.0], &vector![WAY.1, angle]);
        let mut draws = NormalDraws::seeded(3);
        let count = 40_000.0;
        let (mut sum, mut squares) = (Vector2::zeros(), Vector2::zeros());
        for _ in 0..40_000 {
            let at = place(&(prior.mean + draws.spread(&prior.covariance)));
            sum += at / count;
            squares += at.component_mul(&at) / count;
        }
        let truth = truly(angle);
        assert!((sum - truth.mean).norm() < 8.0, "{sum}");
        let deviations = (squares - sum.component_mul(&sum)).map(f64::sqrt);
        assert!((deviations - truth.standard_deviations()).norm() < 8.0);
    }
}
