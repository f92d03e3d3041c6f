//! A jammer drowns satellites: strengths of signals over distance, by hand.

use std::f64::consts::PI;

use nalgebra::vector;

use crate::figure::{Axis, FigurePlot, Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Wavelength of the civil signal at 1575.42 MHz, metres.
const WAVELENGTH: f64 = 299_792_458.0 / 1_575.42e6;
/// Least power of a satellite's civil signal at an antenna on the ground, dBW (IS-GPS-200).
const SATELLITE: f64 = -158.5;
/// Signal over noise of an undisturbed receiver, dB-Hz.
const CLEAR: f64 = 44.0;
/// Signal over noise below which the receiver loses the signal, dB-Hz.
const LOST: f64 = 28.0;
/// Rate of the signal's code, over which a narrow disturbance is spread, per second.
const CODE_RATE: f64 = 1.023e6;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "why-gps-fails",
    text: include_str!("../../texts/en/why-gps-fails.md"),
    controls: &[
        LessonControl::slider("distance", [0.5, 60.0], 0.5, 5.0, "km"),
        LessonControl::slider("power", [10.0, 2000.0], 10.0, 100.0, "mW"),
    ],
    compute,
};

/// Factor as decibels, and back.
fn decibels(factor: f64) -> f64 {
    10.0 * factor.log10()
}
fn factor(decibels: f64) -> f64 {
    10f64.powf(decibels / 10.0)
}

/// Power of a jammer of `watts` at an antenna `metres` away in free space, dBW.
fn received(watts: f64, metres: f64) -> f64 {
    decibels(watts) + 2.0 * decibels(WAVELENGTH / (4.0 * PI * metres))
}

/// Signal over noise beside a disturbance that is stronger than the signal by `over` dB, dB-Hz.
fn disturbed(over: f64) -> f64 {
    -decibels(factor(-CLEAR) + factor(over) / CODE_RATE)
}

/// Distance at which a jammer of `watts` just makes the receiver lose the signal, metres.
fn reach(watts: f64) -> f64 {
    let over = decibels(CODE_RATE * (factor(-LOST) - factor(-CLEAR)));
    let allowed = SATELLITE + over;
    WAVELENGTH / (4.0 * PI) * factor((decibels(watts) - allowed) / 2.0)
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (distance, watts) = (setting.get("distance"), setting.get("power") / 1000.0);
    let jammer = received(watts, 1000.0 * distance);
    let over = jammer - SATELLITE;
    let left = disturbed(over);
    LessonOutcome {
        figure: draw(distance, watts, words),
        values: vec![
            Value::new("distance", distance, "km"),
            Value::new("power", 1000.0 * watts, "mW"),
            Value::new("jammer", jammer, "dBW"),
            Value::new("over", over, "dB"),
            Value::new("times", factor(over), ""),
            Value::new("left", left, "dB-Hz"),
            Value::new("reach", reach(watts) / 1000.0, "km"),
        ],
        checks: vec![
            Check::at_least("left", LOST),
            Check::at_least("power", 100.0),
        ],
    }
}

fn draw(distance: f64, watts: f64, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 400.0);
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([0.0, 60.0], words.get("away")),
        Axis::new([0.0, 55.0], words.get("strength")),
    );
    let at = |km: f64| disturbed(received(watts, 1000.0 * km) - SATELLITE);
    svg.part("reach", |svg| {
        let far = (reach(watts) / 1000.0).min(60.0);
        plot.band(svg, &[[0.0, 0.0, 55.0], [far, 0.0, 55.0]], "shade");
    });
    svg.part("clear", |svg| plot.level(svg, CLEAR, "truth"));
    svg.part("lost", |svg| plot.level(svg, LOST, "limit"));
    svg.part("left", |svg| {
        let curve: Vec<[f64; 2]> = (1..=240)
            .map(|index| f64::from(index) * 0.25)
            .map(|km| [km, at(km)])
            .collect();
        plot.line(svg, &curve, "estimate");
        plot.dot(svg, [distance, at(distance).max(0.0)], 6.0, "dot-estimate");
    });
    for (level, class, key) in [(CLEAR, "word-truth", "clear"), (LOST, "word-limit", "lost")] {
        let place = plot.at(59.0, level) + vector![0.0, if level == LOST { 17.0 } else { -7.0 }];
        svg.text(place, TextAnchor::End, class, &words.get(key));
    }
    let place = plot.at(59.0, 3.0);
    svg.text(place, TextAnchor::End, "word-estimate", &words.get("left"));
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn free_space_takes_what_tables_say() {
        // 1575.42 MHz over 1 km: 32.45 + 20 lg 1575.42 + 20 lg 1 = 96.40 dB.
        assert!((received(1.0, 1000.0) + 96.40).abs() < 0.01);
    }

    #[test]
    fn the_signal_is_lost_just_at_the_reach() {
        for watts in [0.01, 1.0] {
            let over = received(watts, reach(watts)) - SATELLITE;
            assert!((disturbed(over) - LOST).abs() < 1e-9);
        }
    }
}
