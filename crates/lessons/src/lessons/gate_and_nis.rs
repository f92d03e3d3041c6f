//! A gate by the NIS: what it refuses of the good looks, and what it lets pass of a twin's.

use nalgebra::{Matrix2, Vector2, vector};
use pilotage_estimation::filter::{Gate, Gaussian, Ukf, UnscentedSettings};

use crate::figure::{FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::NormalDraws;
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Deviation of a look, metres on each axis.
const LOOK: f64 = 5.0;
/// Place of the twin seen from the landmark, metres east of it.
const TWIN: f64 = 50.0;
const SEED: u64 = 5;
/// Looks at the landmark, and at its twin.
const LOOKS: [usize; 2] = [500, 100];

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "gate-and-nis",
    text: include_str!("../../texts/en/gate-and-nis.md"),
    controls: &[
        LessonControl::slider("confidence", [50.0, 99.9], 0.1, 99.9, "%"),
        LessonControl::slider("belief", [2.0, 40.0], 1.0, 10.0, "m"),
    ],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let belief = setting.get("belief");
    let gate = Gate {
        confidence: setting.get("confidence") / 100.0,
    };
    let threshold = gate.threshold(2);
    let spread = belief.hypot(LOOK);
    let judged = judged(belief, gate);
    let share = |twin: bool, accepted: bool| {
        let of = judged.iter().filter(|look| look.twin == twin);
        let count = of.clone().count().max(1) as f64;
        100.0 * of.filter(|look| look.accepted == accepted).count() as f64 / count
    };
    LessonOutcome {
        figure: draw(&judged, spread, threshold, words),
        values: vec![
            Value::new("confidence", setting.get("confidence"), "%"),
            Value::new("spread", spread, "m"),
            Value::new("threshold", threshold, ""),
            Value::new("radius", spread * threshold.sqrt(), "m"),
            Value::new("twin", (TWIN / spread).powi(2), ""),
            Value::new("refused", share(false, false), "%"),
            Value::new("passed", share(true, true), "%"),
        ],
        checks: vec![
            Check::at_most("refused", 6.0),
            Check::at_most("passed", 6.0),
        ],
    }
}

/// Look at the landmark or its twin, by its innovation, metres east and north.
struct Judged {
    innovation: Vector2<f64>,
    twin: bool,
    accepted: bool,
}

fn judged(belief: f64, gate: Gate) -> Vec<Judged> {
    let prior = Gaussian::from_standard_deviations(Vector2::zeros(), &vector![belief, belief]);
    let noise = Matrix2::identity() * (LOOK * LOOK);
    let filter = Ukf::new(prior, UnscentedSettings::default());
    let Ok(expected) = filter.and_then(|it| it.predict_measurement(|x| Some(*x), &noise)) else {
        return Vec::new();
    };
    let mut draws = NormalDraws::seeded(SEED);
    let looks = LOOKS.iter().zip([false, true]);
    let twins = looks.flat_map(|(count, twin)| std::iter::repeat_n(twin, *count));
    twins
        .map(|twin| {
            let error = draws.vector() * belief - draws.vector() * LOOK;
            let innovation = vector![if twin { TWIN } else { 0.0 }, 0.0] + error;
            let seen = expected.mean + innovation;
            Judged {
                innovation,
                twin,
                accepted: gate.judge(&expected, &seen).accepted,
            }
        })
        .collect()
}

fn draw(judged: &[Judged], spread: f64, threshold: f64, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 460.0);
    let corners = [Vector2::zeros(), vector![640.0, 460.0]];
    let (east, north) = (words.get("east"), words.get("north"));
    let plot = FigurePlot::map(
        &mut svg,
        corners,
        vector![25.0, 0.0],
        135.0,
        [&east, &north],
    );
    for (part, twin, class) in [
        ("good", false, "dot-truth"),
        ("wrong", true, "dot-estimate"),
    ] {
        svg.part(part, |svg| {
            for look in judged.iter().filter(|look| look.twin == twin) {
                let at = [look.innovation.x, look.innovation.y];
                let (radius, class) = if look.accepted {
                    (3.0, class)
                } else {
                    (3.5, "refused")
                };
                plot.dot(svg, at, radius, class);
            }
        });
    }
    svg.part("gate", |svg| {
        let radius = spread * threshold.sqrt();
        let points: Vec<[f64; 2]> = (0..=90)
            .map(|n| (f64::from(n) * 4.0_f64).to_radians())
            .map(|turn| [radius * turn.cos(), radius * turn.sin()])
            .collect();
        plot.line(svg, &points, "limit");
    });
    svg.part("twin", |svg| plot.dot(svg, [TWIN, 0.0], 7.0, "landmark"));
    plot.key(
        &mut svg,
        &[
            (&words.get("good"), "word-truth"),
            (&words.get("wrong"), "word-estimate"),
            (&words.get("refused"), "word-limit"),
            (&words.get("gate"), "word-limit"),
            (&words.get("twin"), "word-look"),
        ],
    );
    svg
}
