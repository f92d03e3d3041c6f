//! Distinct landmarks: what looks like nothing else around it.

use nalgebra::{Vector2, vector};
use pilotage_raster::raster::{Gray, Peak, Raster, Template, highest_peak, rival_peak};

use crate::figure::{Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::normal_numbers;
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Columns and rows of the map, and metres of a pixel.
const SIZE: [usize; 2] = [50, 34];
const PIXEL: f64 = 3.0;
/// Pixels around a match in which no other counts as its rival.
const APART: f64 = 3.0;
/// Seeds of the trees and of the other day, as the text says them.
const TREES: u64 = 8;
const DAY: u64 = 9;
/// Middles of the house, the crossing and the pond: column and row of the pixel there.
const PLACES: [[usize; 2]; 3] = [[15, 21], [24, 10], [38, 21]];

/// Plots where no house stands, column and row.
const EMPTY: [[usize; 2]; 3] = [[13, 13], [7, 28], [37, 5]];

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "distinct-landmarks",
    text: include_str!("../../texts/en/distinct-landmarks.md"),
    controls: &[
        LessonControl::slider("side", [15.0, 45.0], 6.0, 15.0, "m"),
        LessonControl::slider("change", [0.0, 100.0], 10.0, 0.0, "%"),
        LessonControl::choice("landmark", 3),
    ],
    compute,
};

/// The map: two streets and a road across them, rows of equal houses, a pond with an island, trees. Black is 0, white 1.
fn map() -> Gray {
    let mut map = Raster::from_fn(SIZE[0], SIZE[1], |x, y| {
        let road = (24..26).contains(&x) || [10, 11, 25, 26].contains(&y);
        if road { 0.6 } else { 0.45 }
    });
    let mut fill = |[x, y]: [usize; 2], [w, h]: [usize; 2], shade: f32| {
        for row in y..(y + h).min(SIZE[1]) {
            for column in x..(x + w).min(SIZE[0]) {
                map.set(column, row, shade);
            }
        }
    };
    let mut numbers = normal_numbers(TREES);
    let mut next = || numbers.next().unwrap_or(0.0);
    for _ in 0..40 {
        // Anywhere: what lies on a street or a house is covered below.
        let at = [next(), next()].map(|it| 0.5 + 0.29 * it);
        let place = [0, 1].map(|axis| (at[axis].clamp(0.0, 0.96) * SIZE[axis] as f64) as usize);
        let road =
            (22..26).contains(&place[0]) || [8, 9, 10, 11, 23, 24, 25, 26].contains(&place[1]);
        let shore = (29..46).contains(&place[0]) && (15..26).contains(&place[1]);
        if !(road || shore) {
            fill(place, [3, 3], 0.15);
        }
    }
    for row in [5, 13, 20, 28] {
        for column in (1..48).step_by(6) {
            let pond = row == 20 && (31..43).contains(&column);
            let empty = EMPTY.contains(&[column, row]);
            if !(pond || empty || (20..26).contains(&column)) {
                fill([column, row], [4, 3], 0.95);
            }
        }
    }
    for row in 18..25 {
        for column in 32..45 {
            let off = vector![(column as f64 - 38.0) / 5.0, (row as f64 - 21.0) / 3.0];
            if off.norm() <= 1.0 {
                fill([column, row], [1, 1], 0.05);
            }
        }
    }
    fill(PLACES[2], [1, 1], 0.45);
    map
}

/// The same ground on another day: every pixel has another brightness, by a deviation of 0.3 at 100 %.
fn other_day(map: &Gray, change: f64) -> Gray {
    let mut numbers = normal_numbers(DAY);
    map.map(|shade| shade + (0.3 * change * numbers.next().unwrap_or(0.0)) as f32)
}

/// Place at which a piece of the map is found in a picture, and the next that looks like it.
struct Found {
    /// Corner of the piece on the map, pixels.
    own: Vector2<f64>,
    /// Corner and score of the best match.
    best: (Vector2<f64>, f64),
    /// The same of the second best.
    rival: (Vector2<f64>, f64),
}

fn find(map: &Gray, picture: &Gray, place: [usize; 2], side: usize) -> Option<Found> {
    let [x, y] = place.map(|it| it - side / 2);
    let template = Template::new(&map.crop(x, y, side, side)?)?;
    let surface = template.correlate(picture);
    let best = highest_peak(&surface)?;
    let rival = rival_peak(&surface, &best, APART)?;
    let sample = |peak: &Peak| {
        let (column, row) = peak.sample;
        let score = f64::from(surface.get(column, row));
        (vector![column as f64, row as f64], score)
    };
    Some(Found {
        own: vector![x as f64, y as f64],
        best: sample(&best),
        rival: sample(&rival),
    })
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let side = (setting.get("side") / PIXEL).round() as usize;
    let place = PLACES[setting.chosen("landmark").min(2)];
    let map = map();
    let picture = other_day(&map, setting.get("change") / 100.0);
    let found = find(&map, &picture, place, side);
    let numbers = found.as_ref().map_or([f64::NAN; 4], |it| {
        let off = (it.best.0 - it.own).norm() * PIXEL;
        [it.best.1, it.rival.1, it.best.1 - it.rival.1, off]
    });
    LessonOutcome {
        figure: draw(&picture, found.as_ref(), side, words),
        values: vec![
            Value::new("side", setting.get("side"), "m"),
            Value::new("change", setting.get("change"), "%"),
            Value::new("best", numbers[0], ""),
            Value::new("rival", numbers[1], ""),
            Value::new("margin", numbers[2], ""),
            Value::new("off", numbers[3], "m"),
        ],
        checks: vec![
            Check::at_least("margin", 0.3),
            Check::at_most("off", 3.0),
            Check::at_least("change", 70.0),
        ],
    }
}

fn draw(picture: &Gray, found: Option<&Found>, side: usize, words: &Words) -> Svg {
    const SCALE: f64 = 12.0;
    let mut svg = Svg::new(640.0, 460.0);
    let corner = vector![20.0, 12.0];
    svg.part("picture", |svg| {
        for row in 0..picture.height() {
            for column in 0..picture.width() {
                let at = corner + vector![column as f64, row as f64] * SCALE;
                svg.pixel(at, SCALE, f64::from(picture.get(column, row)));
            }
        }
    });
    if let Some(found) = found {
        let mut frame = |part: &str, place: Vector2<f64>, class: &str, grown: f64| {
            svg.part(part, |svg| {
                let low = corner + place * SCALE - Vector2::repeat(grown);
                let length = side as f64 * SCALE + 2.0 * grown;
                svg.rect(low, low + Vector2::repeat(length), class);
            });
        };
        frame("rival", found.rival.0, "refused", 0.0);
        frame("own", found.own, "truth", 3.0);
        frame("best", found.best.0, "estimate", 0.0);
    }
    let names = [
        ("own", "word-truth", 20.0, TextAnchor::Start),
        ("best", "word-estimate", 320.0, TextAnchor::Middle),
        ("rival", "word-limit", 620.0, TextAnchor::End),
    ];
    for (key, class, x, anchor) in names {
        svg.text(vector![x, 444.0], anchor, class, &words.get(key));
    }
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_piece_of_the_map_is_found_in_the_map_where_it_lies() {
        let map = map();
        for place in PLACES {
            let found = find(&map, &map, place, 15).unwrap();
            assert_eq!(found.best.0, found.own);
            assert!((found.best.1 - 1.0).abs() < 1e-5);
        }
    }
}
