//! Correlation and its look-alikes: a house in a street of equal houses.

use nalgebra::vector;
use pilotage_raster::raster::{Gray, Peak, Template, highest_peak, rival_peak};
use pilotage_vision::landmark::TemplateSettings;

use crate::figure::{Axis, FigurePlot, Svg};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{DrawnDay, DrawnGround, House, draw_box, draw_picture, pictured};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Size of the picture, pixels of a metre.
const SIZE: [usize; 2] = [47, 18];
/// Middle of the house that is looked for, pixels.
const WANTED: [f64; 2] = [23.5, 9.5];
/// Distance from one house to the next, metres.
const NEXT: f64 = 9.0;
/// Noise of the picture, grey levels, and its seed.
const NOISE: (f64, u64) = (8.0, 5);
/// Distance from a peak at which another one is a rival, metres.
const APART: f64 = 4.0;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "look-alikes",
    text: include_str!("../../texts/en/look-alikes.md"),
    controls: &[
        LessonControl::slider("side", [7.0, 17.0], 2.0, 7.0, "m"),
        LessonControl::choice("street", 2),
    ],
    compute,
};

/// Street of five equal houses, with trees and sheds that differ or with the same tree at each.
fn street(is_uniform: bool) -> DrawnGround {
    let middles = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| [WANTED[0] + k * NEXT, WANTED[1]]);
    let mut houses: Vec<House> = middles
        .map(|middle| House {
            middle,
            half: [2.5, 3.0],
        })
        .to_vec();
    let trees = if is_uniform {
        middles.map(|[x, y]| ([x + 4.5, y - 4.0], 1.8)).to_vec()
    } else {
        houses.extend([[10.0, 14.5], [37.0, 4.5]].map(|middle| House {
            middle,
            half: [1.6, 1.6],
        }));
        vec![([19.0, 5.0], 2.2), ([28.0, 14.0], 2.2), ([46.0, 14.0], 2.2)]
    };
    DrawnGround {
        houses,
        trees,
        texture: if is_uniform { 0.0 } else { 6.0 },
        seed: 3,
        ..DrawnGround::default()
    }
}

/// Scores of the map's patch in the picture: the surface, its summit and the rival.
struct Found {
    picture: Gray,
    surface: Gray,
    best: Peak,
    rival: Option<Peak>,
}

fn found(ground: &DrawnGround, side: usize) -> Option<Found> {
    let map = pictured(SIZE, (0.0, 0), ground.on(DrawnDay::default()));
    let picture = pictured(SIZE, NOISE, ground.on(DrawnDay::default()));
    let [left, top] = WANTED.map(|middle| (middle - side as f64 / 2.0) as usize);
    let template = Template::new(&map.crop(left, top, side, side)?)?;
    let surface = template.correlate(&picture);
    let best = highest_peak(&surface)?;
    let rival = rival_peak(&surface, &best, APART);
    Some(Found {
        picture,
        surface,
        best,
        rival,
    })
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let side = setting.chosen("side");
    let ground = street(setting.chosen("street") == 1);
    let found = found(&ground, side);
    let best = found.as_ref().map_or(0.0, |found| found.best.value);
    let rival = found.as_ref().and_then(|found| found.rival);
    let rival = rival.map_or(0.0, |rival| rival.value);
    let middle = found.as_ref().map_or(0.0, |found| found.best.x) + side as f64 / 2.0;
    LessonOutcome {
        figure: draw(found.as_ref(), side as f64, words),
        values: vec![
            Value::new("side", side as f64, "m"),
            Value::new("pixels", (side * side) as f64, ""),
            Value::new("best", best, ""),
            Value::new("rival", rival, ""),
            Value::new("ratio", rival / best.max(1e-9), ""),
            Value::new("off", (middle - WANTED[0]).abs(), "m"),
        ],
        checks: vec![Check::at_most(
            "ratio",
            TemplateSettings::default().greatest_ambiguity,
        )],
    }
}

fn draw(found: Option<&Found>, side: f64, words: &Words) -> Svg {
    const PIXEL: f64 = 12.0;
    let mut svg = Svg::new(640.0, 440.0);
    let plot = FigurePlot::new(
        &mut svg,
        [vector![0.0, 226.0], vector![640.0, 440.0]],
        Axis::new([0.0, 47.5], words.get("along")),
        Axis::new([-0.5, 1.5], words.get("score")),
    );
    let Some(found) = found else { return svg };
    let corner = vector![56.0, 10.0];
    draw_picture(&mut svg, &found.picture, corner, PIXEL, [40.0, 210.0]);
    svg.part("rival", |svg| {
        if let Some(rival) = &found.rival {
            draw_box(
                svg,
                corner,
                PIXEL,
                [rival.x, rival.y, side, side],
                "reckoning",
            );
            plot.dot(
                svg,
                [rival.x + side / 2.0, rival.value],
                5.0,
                "dot-reckoning",
            );
        }
    });
    svg.part("best", |svg| {
        let best = &found.best;
        draw_box(svg, corner, PIXEL, [best.x, best.y, side, side], "estimate");
        plot.dot(svg, [best.x + side / 2.0, best.value], 5.0, "dot-estimate");
    });
    let over = |column: usize| {
        let rows = 0..found.surface.height();
        let highest = rows
            .map(|row| found.surface.get(column, row))
            .fold(-1.0, f32::max);
        [column as f64 + side / 2.0, f64::from(highest)]
    };
    let line: Vec<[f64; 2]> = (0..found.surface.width()).map(over).collect();
    svg.part("score", |svg| plot.line(svg, &line, "look"));
    plot.key(
        &mut svg,
        &[
            (&words.get("best"), "small word-estimate"),
            (&words.get("rival"), "small word-reckoning"),
        ],
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_gardens_make_equal_houses_look_alike_at_every_size() {
        let ground = street(true);
        for side in (7..=17).step_by(2) {
            let found = found(&ground, side).unwrap();
            let ratio = found.rival.unwrap().value / found.best.value;
            assert!(ratio > 0.85, "{side}: {ratio}");
        }
    }
}
