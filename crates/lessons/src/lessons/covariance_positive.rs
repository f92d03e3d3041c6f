//! The variance after a look by the short form and by Joseph's, for a gain that is not the best one.

use nalgebra::{Matrix1, Vector1};
use pilotage_estimation::filter::{Gaussian, Ukf, UnscentedSettings};

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Deviation of the place before the look, metres.
const PRIOR: f64 = 10.0;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "covariance-positive",
    text: include_str!("../../texts/en/covariance-positive.md"),
    controls: &[
        LessonControl::choice("form", 2),
        LessonControl::slider("gain", [0.5, 1.1], 0.01, 0.9, ""),
        LessonControl::slider("look", [1.0, 20.0], 0.5, 5.0, "m"),
    ],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (gain, look) = (setting.get("gain"), setting.get("look"));
    let (best, least) = filtered(look).unwrap_or((0.0, PRIOR * PRIOR));
    let (short, joseph) = (short(gain, look), joseph(gain, look));
    let stated = if setting.chosen("form") == 0 {
        short
    } else {
        joseph
    };
    LessonOutcome {
        figure: draw(gain, look, [best, least], words),
        values: vec![
            Value::new("gain", gain, ""),
            Value::new("best", best, ""),
            Value::new("least", least, "m²"),
            Value::new("short", short, "m²"),
            Value::new("joseph", joseph, "m²"),
            Value::new("ratio", stated / joseph, ""),
        ],
        checks: vec![Check::between("ratio", 0.99, 1.01)],
    }
}

/// Best gain and the variance with it, by the filter.
fn filtered(look: f64) -> Option<(f64, f64)> {
    let prior = Gaussian::from_standard_deviations(Vector1::new(0.0), &Vector1::new(PRIOR));
    let mut filter = Ukf::new(prior, UnscentedSettings::default()).ok()?;
    let noise = Matrix1::new(look * look);
    let expected = filter.predict_measurement(|x| Some(*x), &noise).ok()?;
    let correction = filter.correct(&expected, &Vector1::new(0.0)).ok()?;
    Some((correction.gain[0], correction.after.covariance[0]))
}

/// P - K S K: right for the best gain only.
fn short(gain: f64, look: f64) -> f64 {
    let variance = PRIOR * PRIOR;
    variance - gain * (variance + look * look) * gain
}

/// (1 - K) P (1 - K) + K R K: the variance of the error, whatever the gain.
fn joseph(gain: f64, look: f64) -> f64 {
    (1.0 - gain).powi(2) * PRIOR * PRIOR + gain * gain * look * look
}

fn draw(gain: f64, look: f64, [best, least]: [f64; 2], words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 400.0);
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([0.0, 1.1], words.get("gain")),
        Axis::new([-60.0, 120.0], words.get("variance")),
    );
    let curve = |of: fn(f64, f64) -> f64| -> Vec<[f64; 2]> {
        let gains = (0..=220).map(|n| 0.005 * f64::from(n));
        gains.map(|gain| [gain, of(gain, look)]).collect()
    };
    svg.part("negative", |svg| {
        plot.band(svg, &[[0.0, -60.0, 0.0], [1.1, -60.0, 0.0]], "shade");
    });
    svg.part("joseph", |svg| plot.line(svg, &curve(joseph), "truth"));
    svg.part("short", |svg| plot.line(svg, &curve(short), "estimate"));
    svg.part("best", |svg| plot.dot(svg, [best, least], 7.0, "sigma"));
    svg.part("setting", |svg| {
        plot.line(svg, &[[gain, -60.0], [gain, 120.0]], "limit");
        plot.dot(svg, [gain, joseph(gain, look)], 5.0, "dot-truth");
        plot.dot(svg, [gain, short(gain, look)], 5.0, "dot-estimate");
    });
    plot.key(
        &mut svg,
        &[
            (&words.get("joseph"), "word-truth"),
            (&words.get("short"), "word-estimate"),
            (&words.get("best"), ""),
            (&words.get("setting"), "word-limit"),
        ],
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_are_the_filter_s_at_the_best_gain() {
        for look in [1.0, 5.0, 20.0] {
            let (best, least) = filtered(look).unwrap();
            assert!((short(best, look) - least).abs() < 1e-9);
            assert!((joseph(best, look) - least).abs() < 1e-9);
        }
    }
}
