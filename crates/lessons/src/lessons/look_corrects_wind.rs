//! A look that measures a place corrects the wind as well: the cross covariance.

use nalgebra::{Matrix2, Vector2, matrix, vector};
use pilotage_base::frames::{Attitude, GroundPoint};
use pilotage_estimation::filter::{Gaussian, Ukf, UnscentedSettings};
use pilotage_estimation::vehicle::{AirplaneWind, ControlInput, VehicleModel};

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{CRUISE, START, noiseless_airplane};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Innovation to the north, metres.
const INNOVATION: f64 = 60.0;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "look-corrects-wind",
    text: include_str!("../../texts/en/look-corrects-wind.md"),
    controls: &[
        LessonControl::slider("wait", [0.0, 60.0], 5.0, 30.0, "s"),
        LessonControl::slider("look", [1.0, 40.0], 1.0, 5.0, "m"),
    ],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (wait, look) = (setting.get("wait"), setting.get("look"));
    let (before, after, gain) = corrected(wait, look).unwrap_or_else(|| {
        let none = Gaussian::new(Vector2::zeros(), Matrix2::identity());
        (none, none, Vector2::zeros())
    });
    let [had, has] = [before, after].map(|belief| belief.standard_deviations());
    LessonOutcome {
        figure: draw(&before, &after, look, words),
        values: vec![
            Value::new("wait", wait, "s"),
            Value::new("place-before", had[0], "m"),
            Value::new("wind-before", had[1], "m/s"),
            Value::new("shared", before.covariance[(0, 1)], "m²/s"),
            Value::new(
                "correlation",
                before.covariance[(0, 1)] / (had[0] * had[1]),
                "",
            ),
            Value::new("gain-place", gain[0], ""),
            Value::new("gain-wind", gain[1], "1/s"),
            Value::new("moved-wind", after.mean[1], "m/s"),
            Value::new("place-after", has[0], "m"),
            Value::new("wind-after", has[1], "m/s"),
        ],
        checks: vec![Check::at_most("wind-after", 0.15)],
    }
}

/// Belief in place and wind to the north before and after the look, seen from what was expected, and the gain. The
/// instruments are without noise here.
fn corrected(wait: f64, look: f64) -> Option<(Gaussian<2>, Gaussian<2>, Vector2<f64>)> {
    let model = AirplaneWind {
        start_wind_deviation: 2.0,
        ..noiseless_airplane()
    };
    let input = ControlInput::new(CRUISE, Attitude::level(0.0));
    let prior = model.prior(GroundPoint::new(0.0, 0.0), START);
    let mut filter = Ukf::new(prior, UnscentedSettings::default()).ok()?;
    let noise = model.process_noise(filter.mean(), &input, wait);
    filter
        .predict(|x| model.propagate(x, &input, wait), &noise)
        .ok()?;
    let noise = Matrix2::identity() * (look * look);
    let expected = filter
        .predict_measurement(|x| Some(vector![x[0], x[1]]), &noise)
        .ok()?;
    let seen = expected.mean + vector![INNOVATION, 0.0];
    let correction = filter.correct(&expected, &seen).ok()?;
    let start = correction.before.mean;
    let north = |belief: &Gaussian<4>| {
        let p = belief.covariance;
        let moved = belief.mean - start;
        Gaussian::new(
            vector![moved[0], moved[2]],
            matrix![p[(0, 0)], p[(0, 2)]; p[(2, 0)], p[(2, 2)]],
        )
    };
    let gain = vector![correction.gain[(0, 0)], correction.gain[(2, 0)]];
    Some((north(&correction.before), north(&correction.after), gain))
}

fn draw(before: &Gaussian<2>, after: &Gaussian<2>, look: f64, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 420.0);
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([-300.0, 300.0], words.get("place")),
        Axis::new([-6.0, 10.0], words.get("wind")),
    );
    svg.part("look", |svg| {
        let [from, to] = [INNOVATION - 2.0 * look, INNOVATION + 2.0 * look];
        plot.band(svg, &[[from, -6.0, 10.0], [to, -6.0, 10.0]], "likelihood");
    });
    svg.part("before", |svg| {
        plot.ellipse(svg, [0.0, 0.0], &before.covariance, 2.0, "prior");
    });
    svg.part("after", |svg| {
        let at = [after.mean[0], after.mean[1]];
        plot.ellipse(svg, at, &after.covariance, 2.0, "belief");
    });
    svg.part("gain", |svg| {
        plot.line(
            svg,
            &[[0.0, 0.0], [after.mean[0], after.mean[1]]],
            "estimate",
        );
        plot.dot(svg, [after.mean[0], after.mean[1]], 4.0, "dot-estimate");
    });
    plot.key(
        &mut svg,
        &[
            (&words.get("before"), "word-reckoning"),
            (&words.get("seen"), "word-look"),
            (&words.get("after"), "word-estimate"),
        ],
    );
    svg
}
