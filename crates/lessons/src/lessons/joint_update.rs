//! Two landmarks of one picture together, or one after the other as if their errors were independent.

use nalgebra::{Matrix1, Matrix2, Vector1, vector};
use pilotage_estimation::filter::{Gaussian, Ukf, UnscentedSettings};

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Deviation of the place before the picture, metres.
const PRIOR: f64 = 20.0;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "joint-update",
    text: include_str!("../../texts/en/joint-update.md"),
    controls: &[
        LessonControl::choice("way", 2),
        LessonControl::slider("common", [0.0, 10.0], 0.5, 4.0, "m"),
        LessonControl::slider("own", [0.5, 10.0], 0.5, 3.0, "m"),
    ],
    compute,
};

/// Deviation that a filter states, and that which its errors have, metres.
#[derive(Clone, Copy)]
struct Sureness {
    stated: f64,
    real: f64,
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (common, own) = (setting.get("common"), setting.get("own"));
    let together = setting.chosen("way") == 1;
    let none = Sureness {
        stated: PRIOR,
        real: PRIOR,
    };
    let update = |common: f64| {
        let update = if together { jointly } else { one_by_one };
        update(common, own).unwrap_or(none)
    };
    let shown = update(common);
    let gain = jointly_gain(common, own).unwrap_or(0.0);
    LessonOutcome {
        figure: draw(&update, common, words),
        values: vec![
            Value::new("single", own.hypot(common), "m"),
            Value::new("alike", common * common / (own * own + common * common), ""),
            Value::new("joint-gain", gain, ""),
            Value::new("stated", shown.stated, "m"),
            Value::new("real", shown.real, "m"),
            Value::new("ratio", shown.real / shown.stated, ""),
        ],
        checks: vec![
            Check::between("ratio", 0.95, 1.05),
            Check::at_least("alike", 0.6),
        ],
    }
}

fn prior() -> Gaussian<1> {
    Gaussian::from_standard_deviations(Vector1::new(0.0), &Vector1::new(PRIOR))
}

/// Covariance of the two looks' errors.
fn noise(common: f64, own: f64) -> Matrix2<f64> {
    Matrix2::from_element(common * common) + Matrix2::identity() * (own * own)
}

fn jointly(common: f64, own: f64) -> Option<Sureness> {
    let mut filter = Ukf::new(prior(), UnscentedSettings::default()).ok()?;
    let noise = noise(common, own);
    let expected = filter
        .predict_measurement(|x| Some(vector![x[0], x[0]]), &noise)
        .ok()?;
    let gain = filter.correct(&expected, &vector![0.0, 0.0]).ok()?.gain;
    let left = 1.0 - gain.sum();
    let real = left * left * PRIOR * PRIOR + (gain * noise * gain.transpose())[0];
    Some(Sureness {
        stated: filter.state().standard_deviations()[0],
        real: real.sqrt(),
    })
}

fn jointly_gain(common: f64, own: f64) -> Option<f64> {
    let mut filter = Ukf::new(prior(), UnscentedSettings::default()).ok()?;
    let expected = filter
        .predict_measurement(|x| Some(vector![x[0], x[0]]), &noise(common, own))
        .ok()?;
    Some(filter.correct(&expected, &vector![0.0, 0.0]).ok()?.gain[0])
}

fn one_by_one(common: f64, own: f64) -> Option<Sureness> {
    let mut filter = Ukf::new(prior(), UnscentedSettings::default()).ok()?;
    let alone = Matrix1::new(own * own + common * common);
    // The estimate's error as weights of the prior's error and of the two looks' errors.
    let mut weights = vector![1.0, 0.0, 0.0];
    for look in 1..=2 {
        let expected = filter.predict_measurement(|x| Some(*x), &alone).ok()?;
        let gain = filter.correct(&expected, &Vector1::new(0.0)).ok()?.gain[0];
        weights *= 1.0 - gain;
        weights[look] = gain;
    }
    let looks = vector![weights[1], weights[2]];
    let real = (weights[0] * PRIOR).powi(2) + looks.dot(&(noise(common, own) * looks));
    Some(Sureness {
        stated: filter.state().standard_deviations()[0],
        real: real.sqrt(),
    })
}

fn draw(update: &impl Fn(f64) -> Sureness, common: f64, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 400.0);
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([0.0, 10.0], words.get("common")),
        Axis::new([0.0, 14.0], words.get("deviation")),
    );
    let along: Vec<(f64, Sureness)> = (0..=40)
        .map(|n| f64::from(n) / 4.0)
        .map(|common| (common, update(common)))
        .collect();
    let line = |of: fn(&Sureness) -> f64| -> Vec<[f64; 2]> {
        along
            .iter()
            .map(|(common, sure)| [*common, of(sure)])
            .collect()
    };
    svg.part("real", |svg| {
        plot.line(svg, &line(|sure| sure.real), "truth");
    });
    svg.part("stated", |svg| {
        plot.line(svg, &line(|sure| sure.stated), "estimate");
    });
    let now = update(common);
    svg.part("setting", |svg| {
        plot.line(svg, &[[common, 0.0], [common, 14.0]], "limit");
        plot.dot(svg, [common, now.real], 5.0, "dot-truth");
        plot.dot(svg, [common, now.stated], 5.0, "dot-estimate");
    });
    plot.key(
        &mut svg,
        &[
            (&words.get("real"), "word-truth"),
            (&words.get("stated"), "word-estimate"),
            (&words.get("setting"), "word-limit"),
        ],
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn with_independent_errors_both_ways_are_the_same() {
        let [first, second] = [jointly(0.0, 3.0).unwrap(), one_by_one(0.0, 3.0).unwrap()];
        assert!((first.stated - second.stated).abs() < 1e-9);
        assert!((first.real - first.stated).abs() < 1e-9);
    }
}
