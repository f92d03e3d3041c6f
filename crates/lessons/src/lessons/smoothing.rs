//! Smoothing: what later looks say of an earlier time.

use nalgebra::vector;
use pilotage_estimation::filter::{Gaussian, SmootherLink, smooth};
use pilotage_estimation::vehicle::AirplaneWind;

use crate::figure::{Axis, FigurePlot, Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{LookedFlight, LookedStep};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

const SEED: u64 = 4;
/// Steps of a second; the gap without looks lies in their middle.
const STEPS: usize = 120;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "smoothing",
    text: include_str!("../../texts/en/smoothing.md"),
    controls: &[
        LessonControl::slider("gap", [10.0, 80.0], 10.0, 60.0, "s"),
        LessonControl::choice("estimate", 2),
    ],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let gap = setting.get("gap").round() as usize;
    let from = (STEPS - gap) / 2;
    let flight = LookedFlight {
        seed: SEED,
        real: model(),
        believed: model(),
        step: 1.0,
        steps: STEPS,
        every: 5,
        // The last look before the gap and the first after it are on its edges.
        blind: [from + 1, from + gap],
        look: 5.0,
    };
    let steps = flight.fly();
    let smoothed = smoothed(&steps);
    let filtered: Vec<_> = steps.iter().map(|step| step.belief).collect();
    let worst = |beliefs: &[Gaussian<4>]| {
        let deviations = beliefs.iter().map(|belief| belief.standard_deviations()[0]);
        deviations.enumerate().fold(
            (0, 0.0),
            |most, now| if now.1 > most.1 { now } else { most },
        )
    };
    let (filter_at, filter_most) = worst(&filtered);
    let (smooth_at, smooth_most) = worst(&smoothed);
    let misses = |beliefs: &[Gaussian<4>]| {
        let errors = beliefs
            .iter()
            .zip(&steps)
            .map(|(belief, step)| belief.mean[0] - step.truth[0]);
        (errors.map(|error| error * error).sum::<f64>() / steps.len() as f64).sqrt()
    };
    let chosen = if setting.chosen("estimate") == 0 {
        filter_most
    } else {
        smooth_most
    };
    LessonOutcome {
        figure: draw(&steps, [&filtered, &smoothed], words),
        values: vec![
            Value::new("gap", setting.get("gap"), "s"),
            Value::new("filter-most", filter_most, "m"),
            Value::new("filter-at", steps[filter_at].time, "s"),
            Value::new("smooth-most", smooth_most, "m"),
            Value::new("smooth-at", steps[smooth_at].time, "s"),
            Value::new("filter-error", misses(&filtered), "m"),
            Value::new("smooth-error", misses(&smoothed), "m"),
            Value::new("most", chosen, "m"),
        ],
        checks: vec![Check::at_most("most", 5.0)],
    }
}

fn model() -> AirplaneWind {
    AirplaneWind {
        wind_noise_density: 0.1,
        start_wind_deviation: 1.0,
        ..AirplaneWind::default()
    }
}

/// Beliefs at the ends of the steps, each with all looks of the flight.
fn smoothed(steps: &[LookedStep]) -> Vec<Gaussian<4>> {
    let links: Vec<SmootherLink<4>> = steps.iter().map(|step| step.link).collect();
    let last = steps.last().map(|step| step.belief);
    let beliefs = last.and_then(|last| smooth(&links, &last).ok());
    // The first of them is the start, before the first step.
    beliefs.map_or_else(Vec::new, |beliefs| beliefs.into_iter().skip(1).collect())
}

fn draw(steps: &[LookedStep], [filtered, smoothed]: [&[Gaussian<4>]; 2], words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 420.0);
    let most = 180.0;
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([0.0, STEPS as f64], words.get("time")),
        Axis::new([-most, most], words.get("error")),
    );
    let band = |beliefs: &[Gaussian<4>]| -> Vec<[f64; 3]> {
        let each = beliefs.iter().zip(steps);
        each.map(|(belief, step)| {
            let (off, twice) = (
                belief.mean[0] - step.truth[0],
                2.0 * belief.standard_deviations()[0],
            );
            [step.time, off - twice, off + twice]
        })
        .collect()
    };
    let line = |beliefs: &[Gaussian<4>]| -> Vec<[f64; 2]> {
        let each = beliefs.iter().zip(steps);
        each.map(|(belief, step)| [step.time, belief.mean[0] - step.truth[0]])
            .collect()
    };
    svg.part("filter", |svg| {
        plot.band(svg, &band(filtered), "prior");
        plot.line(svg, &line(filtered), "reckoning");
    });
    svg.part("smooth", |svg| {
        plot.band(svg, &band(smoothed), "belief");
        plot.line(svg, &line(smoothed), "estimate");
    });
    svg.part("truth", |svg| plot.level(svg, 0.0, "truth"));
    svg.part("looks", |svg| {
        for step in steps.iter().filter(|step| step.nis.is_some()) {
            svg.circle(
                plot.at(step.time, -most) - vector![0.0, 6.0],
                3.0,
                "dot-look",
            );
        }
    });
    // At the left, where the bands are narrow.
    let key = [
        ("truth", "word-truth"),
        ("filter", "word-reckoning"),
        ("smooth", "word-estimate"),
        ("looks", "word-look"),
    ];
    for (line, (name, class)) in key.into_iter().enumerate() {
        let at = vector![64.0, 30.0 + 17.0 * line as f64];
        svg.text(at, TextAnchor::Start, class, &words.get(name));
    }
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smoother_is_never_less_sure_than_the_filter() {
        let flight = LookedFlight {
            seed: SEED,
            real: model(),
            believed: model(),
            step: 1.0,
            steps: 60,
            every: 5,
            blind: [21, 40],
            look: 5.0,
        };
        let steps = flight.fly();
        let smoothed = smoothed(&steps);
        assert_eq!(smoothed.len(), steps.len());
        for (belief, step) in smoothed.iter().zip(&steps) {
            let [later, now] = [belief, &step.belief].map(|it| it.standard_deviations()[0]);
            assert!(later <= now + 1e-9, "{}: {later} against {now}", step.time);
        }
    }
}
