//! A look at a landmark corrects the belief: the gain, by hand.

use nalgebra::{Matrix1, Vector1, vector};
use pilotage_estimation::filter::{Gaussian, Ukf, UnscentedSettings};

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::bell;
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Place at which dead reckoning has the aircraft along the road, and its deviation, metres.
const RECKONED: (f64, f64) = (0.0, 10.0);
/// Place at which the look has it, metres.
const LOOKED: f64 = 12.0;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "landmark-corrects",
    text: include_str!("../../texts/en/landmark-corrects.md"),
    controls: &[LessonControl::slider("look", [1.0, 40.0], 0.5, 5.0, "m")],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let look = setting.get("look");
    let prior =
        Gaussian::from_standard_deviations(Vector1::new(RECKONED.0), &Vector1::new(RECKONED.1));
    let (after, gain, nis) = corrected(prior, look).unwrap_or((prior, 0.0, f64::NAN));
    let deviation = after.standard_deviations()[0];
    LessonOutcome {
        figure: draw(&after, look, words),
        values: vec![
            Value::new("reckoned", RECKONED.1, "m"),
            Value::new("look", look, "m"),
            Value::new("innovation", LOOKED - RECKONED.0, "m"),
            Value::new("innovation-deviation", RECKONED.1.hypot(look), "m"),
            Value::new("gain", gain, ""),
            Value::new("place", after.mean[0], "m"),
            Value::new("after", deviation, "m"),
            Value::new("nis", nis, ""),
            Value::new("moved", 100.0 * gain, "%"),
        ],
        checks: vec![Check::at_most("after", 3.0), Check::at_least("look", 2.0)],
    }
}

/// Belief after the look, the gain, and the innovation in its own deviations, squared.
fn corrected(prior: Gaussian<1>, look: f64) -> Option<(Gaussian<1>, f64, f64)> {
    let mut filter = Ukf::new(prior, UnscentedSettings::default()).ok()?;
    let noise = Matrix1::new(look * look);
    let predicted = filter
        .predict_measurement(|x| Some(Vector1::new(x[0])), &noise)
        .ok()?;
    let measured = Vector1::new(LOOKED);
    let innovation = predicted.innovation(&measured);
    let nis = predicted.nis(&innovation);
    let correction = filter.correct(&predicted, &measured).ok()?;
    let gain = (correction.after.mean[0] - prior.mean[0]) / innovation[0];
    Some((correction.after, gain, nis))
}

fn draw(after: &Gaussian<1>, look: f64, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 400.0);
    let span = [-35.0, 45.0];
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new(span, words.get("place")),
        Axis::new([0.0, 0.15], words.get("density")),
    );
    let curve = |svg: &mut Svg, mean: f64, deviation: f64, class: &str| {
        let points: Vec<[f64; 3]> = bell(mean, deviation, span)
            .iter()
            .map(|[x, y]| [*x, 0.0, *y])
            .collect();
        plot.band(svg, &points, class);
    };
    svg.part("prior", |svg| curve(svg, RECKONED.0, RECKONED.1, "prior"));
    svg.part("look", |svg| curve(svg, LOOKED, look, "likelihood"));
    svg.part("after", |svg| {
        curve(svg, after.mean[0], after.standard_deviations()[0], "belief");
    });
    let moved = [plot.at(RECKONED.0, 0.004), plot.at(after.mean[0], 0.004)];
    svg.part("gain", |svg| {
        svg.line(moved[0], moved[1], "estimate");
        svg.circle(moved[1], 4.0, "dot-estimate");
    });
    svg.part("innovation", |svg| {
        let [from, to] =
            [plot.at(RECKONED.0, 0.0), plot.at(LOOKED, 0.0)].map(|at| at - vector![0.0, 3.0]);
        svg.line(from, to, "limit");
    });
    plot.key(
        &mut svg,
        &[
            (&words.get("prior"), "word-reckoning"),
            (&words.get("seen"), "word-look"),
            (&words.get("posterior"), "word-estimate"),
        ],
    );
    svg
}
