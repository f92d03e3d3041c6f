//! A score surface: its summit lies between the pixels.

use nalgebra::vector;
use pilotage_raster::raster::{Gray, Peak, Template, highest_peak};

use crate::figure::{Axis, FigurePlot, Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{draw_picture, pictured};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Sides of the searched picture and of the patch, pixels.
const SEARCH: usize = 19;
const PATCH: usize = 11;
/// Draws of the noise over which errors are taken, and the seed of the first.
const DRAWS: u64 = 40;
const SEED: u64 = 100;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "score-surface",
    text: include_str!("../../texts/en/score-surface.md"),
    controls: &[
        LessonControl::slider("shift", [-0.5, 0.5], 0.05, 0.3, "px"),
        LessonControl::slider("noise", [0.0, 40.0], 2.0, 0.0, "grey levels"),
    ],
    compute,
};

/// Brightness of a thing in the middle of the picture, the same above and below its middle.
fn thing(x: f64, y: f64) -> f64 {
    let middle = SEARCH as f64 / 2.0;
    let hill = |dx: f64, dy: f64, width: f64| {
        let (u, v) = (x - middle - dx, y - middle - dy);
        (-(u * u + v * v) / (2.0 * width * width)).exp()
    };
    80.0 + 110.0 * hill(-1.0, 0.0, 1.6) - 60.0 * (hill(3.0, 2.2, 1.4) + hill(3.0, -2.2, 1.4))
}

/// Surface of scores of the patch over a picture in which all is moved to the right by `shift` pixels.
fn surface(shift: f64, noise: (f64, u64)) -> Option<Gray> {
    let map = pictured([SEARCH; 2], (0.0, 0), thing);
    let picture = pictured([SEARCH; 2], noise, |x, y| thing(x - shift, y));
    let rim = (SEARCH - PATCH) / 2;
    let template = Template::new(&map.crop(rim, rim, PATCH, PATCH)?)?;
    Some(template.correlate(&picture))
}

/// Place of a summit, pixels to the right of where the patch lies on the map.
fn moved(peak: &Peak) -> f64 {
    peak.x - ((SEARCH - PATCH) / 2) as f64
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (shift, noise) = (setting.get("shift"), setting.get("noise"));
    let shown = surface(shift, (noise, SEED));
    let peak = shown.as_ref().and_then(highest_peak);
    let means = shown
        .as_ref()
        .zip(peak)
        .map_or([0.0; 3], |(shown, peak)| means(shown, &peak));
    let squares: f64 = (0..DRAWS)
        .filter_map(|draw| highest_peak(&surface(shift, (noise, SEED + draw))?))
        .map(|peak| (moved(&peak) - shift).powi(2))
        .sum();
    let found = peak.as_ref().map_or(0.0, moved);
    let sample = peak.map_or(0.0, |peak| peak.sample.0 as f64 - 4.0);
    LessonOutcome {
        figure: draw(shown.as_ref(), peak.as_ref(), shift, words),
        values: vec![
            Value::new("shift", shift, "px"),
            Value::new("noise", noise, "grey levels"),
            Value::new("sample", sample, "px"),
            Value::new("left", means[0], ""),
            Value::new("middle", means[1], ""),
            Value::new("right", means[2], ""),
            Value::new("found", found, "px"),
            Value::new("scatter", (squares / DRAWS as f64).sqrt(), "px"),
        ],
        checks: vec![
            Check::at_least("noise", 8.0),
            Check::at_most("scatter", 0.06),
        ],
    }
}

/// Means of the three columns of scores around the highest sample.
fn means(surface: &Gray, peak: &Peak) -> [f64; 3] {
    let (column, row) = peak.sample;
    let mean = |column: usize| {
        let rows = row.saturating_sub(1)..(row + 2).min(surface.height());
        let count = rows.len() as f64;
        rows.map(|row| f64::from(surface.get(column, row)))
            .sum::<f64>()
            / count
    };
    [-1_isize, 0, 1].map(|k| {
        let beside = column.saturating_add_signed(k);
        mean(beside.min(surface.width() - 1))
    })
}

fn draw(surface: Option<&Gray>, peak: Option<&Peak>, shift: f64, words: &Words) -> Svg {
    const SIDE: f64 = 28.0;
    let mut svg = Svg::new(640.0, 400.0);
    let plot = FigurePlot::new(
        &mut svg,
        [vector![290.0, 0.0], vector![640.0, 400.0]],
        Axis::new([-3.0, 3.0], words.get("place")),
        Axis::new([0.0, 1.3], words.get("score")),
    );
    let (Some(surface), Some(peak)) = (surface, peak) else {
        return svg;
    };
    let corner = vector![20.0, 60.0];
    svg.part("surface", |svg| {
        draw_picture(svg, surface, corner, SIDE, [-0.5, 1.0]);
    });
    let at = |x: f64, y: f64| corner + SIDE * vector![x + 0.5, y + 0.5];
    svg.part("found", |svg| {
        svg.circle(at(peak.x, peak.y), 6.0, "estimate");
        plot.line(
            svg,
            &[[moved(peak), 0.0], [moved(peak), peak.value]],
            "estimate",
        );
    });
    svg.part("shift", |svg| {
        let place = at(4.0 + shift, 4.0);
        svg.line(
            place - vector![0.0, 16.0],
            place + vector![0.0, 16.0],
            "truth",
        );
        plot.line(svg, &[[shift, 0.0], [shift, 1.0]], "truth");
    });
    svg.text(
        vector![20.0, 44.0],
        TextAnchor::Start,
        "small",
        &words.get("surface"),
    );
    let row = peak.sample.1;
    svg.part("samples", |svg| {
        for column in 1..8 {
            let score = f64::from(surface.get(column, row));
            plot.dot(svg, [column as f64 - 4.0, score], 5.0, "dot");
        }
    });
    svg.part("hill", |svg| {
        let slope = peak.hessian[(0, 0)];
        let hill: Vec<[f64; 2]> = (-20..=20)
            .map(|k| {
                let x = peak.x + f64::from(k) * 0.075;
                [x - 4.0, peak.value + 0.5 * slope * (x - peak.x).powi(2)]
            })
            .filter(|[x, y]| x.abs() <= 3.0 && *y >= 0.0)
            .collect();
        plot.line(svg, &hill, "reckoning");
    });
    plot.key(
        &mut svg,
        &[
            (&words.get("samples"), "small"),
            (&words.get("hill"), "small word-reckoning"),
            (&words.get("found"), "small word-estimate"),
            (&words.get("truth"), "small word-truth"),
        ],
    );
    svg
}
