//! The number of looks: twice as many looks are not twice as good.

use nalgebra::{Matrix2, Vector2};
use pilotage_base::frames::{Attitude, GroundPoint};
use pilotage_estimation::filter::{Ukf, UnscentedSettings};
use pilotage_estimation::vehicle::{ControlInput, RandomWalk, VehicleModel};

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Walk of the place that nobody measures, m/√s on each axis, and deviation of a look, metres.
const WALK: f64 = 2.0;
const LOOK: f64 = 10.0;
/// Looks after which nothing changes any more.
const LOOKS: usize = 40;
/// Longest interval, seconds.
const LONGEST: f64 = 60.0;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "how-often-to-look",
    text: include_str!("../../texts/en/how-often-to-look.md"),
    controls: &[
        LessonControl::slider("interval", [1.0, LONGEST], 1.0, 10.0, "s"),
        LessonControl::slider("shared", [0.0, 15.0], 1.0, 0.0, "m"),
    ],
    compute,
};

/// Deviation of one coordinate just before and just after a look, metres, once it stays the same.
fn settled(interval: f64) -> Option<[f64; 2]> {
    let vehicle = RandomWalk {
        position_noise_density: WALK,
    };
    let input = ControlInput::without_airspeed(Attitude::level(0.0));
    let prior = vehicle.prior(GroundPoint::new(0.0, 0.0), LOOK);
    let mut filter = Ukf::new(prior, UnscentedSettings::default()).ok()?;
    let walked = vehicle.process_noise(&Vector2::zeros(), &input, interval);
    let noise = Matrix2::from_diagonal_element(LOOK * LOOK);
    let mut found = [LOOK; 2];
    for _ in 0..LOOKS {
        filter
            .predict(|x| vehicle.propagate(x, &input, interval), &walked)
            .ok()?;
        let before = filter.state().standard_deviations()[0];
        let predicted = filter.predict_measurement(|x| Some(*x), &noise).ok()?;
        let correction = filter.correct(&predicted, &Vector2::zeros()).ok()?;
        found = [before, correction.after.standard_deviations()[0]];
    }
    Some(found)
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (interval, shared) = (setting.get("interval"), setting.get("shared"));
    let [before, after] = settled(interval).unwrap_or([f64::NAN; 2]);
    LessonOutcome {
        figure: draw(interval, shared, words),
        values: vec![
            Value::new("interval", interval, "s"),
            Value::new("looks", 60.0 / interval, ""),
            Value::new("shared", shared, "m"),
            Value::new("walked", WALK * WALK * interval, "m²"),
            Value::new("before", before, "m"),
            Value::new("stated", after, "m"),
            Value::new("after", after.hypot(shared), "m"),
        ],
        checks: vec![Check::at_most("after", 5.0), Check::at_most("looks", 35.0)],
    }
}

fn draw(interval: f64, shared: f64, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 400.0);
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([0.0, LONGEST], words.get("interval")),
        Axis::new([0.0, 28.0], words.get("error")),
    );
    let curve: Vec<(f64, [f64; 2])> = (1..=30)
        .map(|index| f64::from(index) * 2.0)
        .chain([1.0])
        .filter_map(|it| settled(it).map(|found| (it, found)))
        .collect();
    let mut curve = curve;
    curve.sort_by(|a, b| a.0.total_cmp(&b.0));
    let line = |of: fn(&[f64; 2]) -> f64| -> Vec<[f64; 2]> {
        curve
            .iter()
            .map(|(at, found)| [*at, of(found).hypot(shared)])
            .collect()
    };
    svg.part("before", |svg| {
        plot.line(svg, &line(|it| it[0]), "reckoning");
    });
    svg.part("after", |svg| {
        plot.line(svg, &line(|it| it[1]), "estimate");
    });
    svg.part("look", |svg| plot.level(svg, LOOK.hypot(shared), "look"));
    svg.part("shared", |svg| plot.level(svg, shared, "limit"));
    if let Some([before, after]) = settled(interval) {
        plot.dot(
            &mut svg,
            [interval, before.hypot(shared)],
            5.0,
            "dot-reckoning",
        );
        plot.dot(
            &mut svg,
            [interval, after.hypot(shared)],
            6.0,
            "dot-estimate",
        );
    }
    plot.key(
        &mut svg,
        &[
            (&words.get("before"), "word-reckoning"),
            (&words.get("after"), "word-estimate"),
            (&words.get("look"), "word-look"),
            (&words.get("shared"), "word-limit"),
        ],
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_settles_is_the_root_of_riccati_s_equation() {
        // P² - qT P - qT r = 0 before a look.
        for interval in [1.0, 10.0, 60.0] {
            let (walked, noise) = (WALK * WALK * interval, LOOK * LOOK);
            let before = 0.5 * walked + (0.25 * walked * walked + walked * noise).sqrt();
            let after = before * noise / (before + noise);
            let [b, a] = settled(interval).unwrap();
            assert!((b - before.sqrt()).abs() < 1e-3 && (a - after.sqrt()).abs() < 1e-3);
        }
    }
}
