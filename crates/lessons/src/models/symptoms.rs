//! The symptoms of a fault, drawn: innovations, NIS and, which no crew sees, the error.

use nalgebra::vector;

use super::watched_flight::{WatchedRun, gate_of_looks};
use crate::figure::{Axis, FigurePlot, Svg, TextAnchor};
use crate::text::Words;

/// Seconds that are drawn.
const SECONDS: [f64; 2] = [0.0, 300.0];
/// NIS at the upper end of its axis; what is larger is drawn there.
const MOST_NIS: f64 = 20.0;

/// Draws a flight: `reach` metres of innovation up and down, `error` metres of error.
///
/// Parts: `innovation`, `nis`, `gate`, `error`, `deviation`. Words: `innovation`, `nis`, `error`, `time`, `ahead`,
/// `right`, `limits`, `gate`, `off`, `stated`.
pub fn draw_symptoms(flown: &WatchedRun, reach: f64, error: f64, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 480.0);
    let time = || Axis::new(SECONDS, words.get("time"));
    let panel = |from: f64, to: f64| [vector![0.0, from], vector![640.0, to]];
    let upper = FigurePlot::new(
        &mut svg,
        panel(6.0, 188.0),
        time(),
        Axis::new([-reach, reach], words.get("innovation")),
    );
    svg.part("innovation", |svg| {
        for look in &flown.looks {
            let at = [(-1.0, "dot-estimate"), (0.0, "dot-look")];
            for ((aside, class), number) in at.into_iter().zip(look.innovation.iter()) {
                let number = number.clamp(-reach, reach);
                upper.dot(svg, [look.time + aside, number], 3.0, class);
            }
        }
        for sign in [-2.0, 2.0] {
            let line: Vec<[f64; 2]> = flown
                .looks
                .iter()
                .map(|look| [look.time, sign * look.deviation])
                .collect();
            upper.line(svg, &line, "limit");
        }
    });
    let middle = FigurePlot::new(
        &mut svg,
        panel(176.0, 332.0),
        time(),
        Axis::new([0.0, MOST_NIS], words.get("nis")),
    );
    svg.part("gate", |svg| middle.level(svg, gate_of_looks(), "limit"));
    svg.part("nis", |svg| {
        for look in &flown.looks {
            let at = [look.time, look.nis.min(MOST_NIS)];
            if look.accepted {
                middle.dot(svg, at, 3.0, "dot");
            } else {
                middle.dot(svg, at, 4.0, "refused");
            }
        }
    });
    let lower = FigurePlot::new(
        &mut svg,
        panel(320.0, 480.0),
        time(),
        Axis::new([0.0, error], words.get("error")),
    );
    let over_time = |of: fn(&super::watched_flight::FlownMoment) -> f64| -> Vec<[f64; 2]> {
        let moments = flown.moments.iter();
        moments.map(|moment| [moment.time, of(moment)]).collect()
    };
    svg.part("deviation", |svg| {
        lower.line(svg, &over_time(|moment| 2.0 * moment.deviation), "limit");
    });
    svg.part("error", |svg| {
        lower.line(svg, &over_time(|moment| moment.error), "truth");
    });
    // What is drawn is said above each plot, where nothing is drawn.
    for (x, y, anchor, name, colour) in [
        (60.0, 14.0, TextAnchor::Start, "ahead", "estimate"),
        (110.0, 14.0, TextAnchor::Start, "right", "look"),
        (626.0, 14.0, TextAnchor::End, "limits", "limit"),
        (626.0, 182.0, TextAnchor::End, "gate", "limit"),
        (60.0, 326.0, TextAnchor::Start, "off", "truth"),
        (626.0, 326.0, TextAnchor::End, "stated", "limit"),
    ] {
        let class = format!("small word-{colour}");
        svg.text(vector![x, y], anchor, &class, &words.get(name));
    }
    svg
}
