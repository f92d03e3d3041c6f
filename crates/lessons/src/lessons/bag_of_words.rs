//! A bag of words: which kind of ground a window shows.

use std::sync::LazyLock;

use nalgebra::{Vector2, vector};
use pilotage_raster::raster::{Gradient, Gray};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::figure::{Axis, FigurePlot, Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{DrawnDay, DrawnGround, House, draw_picture, pictured};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Side of a window and of a cell, pixels.
const WINDOW: usize = 24;
const CELL: usize = 6;
/// Windows of each class to learn from, and as many to be judged by.
const EACH: u64 = 20;
/// Classes: buildings, fields, trees.
const CLASSES: usize = 3;
/// Most words.
const MOST: usize = 12;
/// Rounds in which words are moved into the middle of what they stand for.
const ROUNDS: usize = 10;
/// Seed of windows and words.
const SEED: u64 = 17;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "bag-of-words",
    text: include_str!("../../texts/en/bag-of-words.md"),
    controls: &[
        LessonControl::slider("words", [1.0, MOST as f64], 1.0, 2.0, ""),
        LessonControl::choice("order", 2),
    ],
    compute,
};

/// Window of a class with the descriptors of its cells, row by row.
struct Seen {
    class: usize,
    picture: Gray,
    cells: Vec<Vector2<f64>>,
}

/// Windows to learn from, and windows to be judged by.
static WINDOWS: LazyLock<[Vec<Seen>; 2]> = LazyLock::new(|| {
    [0, 1].map(|part| {
        let numbers = (0..CLASSES).flat_map(|class| (0..EACH).map(move |number| (class, number)));
        numbers
            .map(|(class, number)| seen(class, part * EACH + number))
            .collect()
    })
});

fn seen(class: usize, number: u64) -> Seen {
    let mut random = ChaCha8Rng::seed_from_u64(SEED + 1000 * class as u64 + number);
    let mut between = |from: f64, to: f64| from + (to - from) * random.random::<f64>();
    let mut ground = DrawnGround {
        texture: 6.0,
        seed: SEED + 7000 + 1000 * class as u64 + number,
        ..DrawnGround::default()
    };
    match class {
        0 => {
            for corner in [[6.0, 6.0], [18.0, 7.0], [8.0, 18.0], [18.0, 18.0]] {
                ground.houses.push(House {
                    middle: corner.map(|at| at + between(-2.0, 2.0)),
                    half: [between(2.0, 4.0), between(2.0, 4.0)],
                });
            }
        }
        1 => {
            let slope = between(-8.0, 8.0);
            let at = between(4.0, 20.0);
            ground.roads.push([[-5.0, at], [29.0, at + slope]]);
            ground.texture = 9.0;
        }
        _ => {
            for _ in 0..16 {
                let middle = [between(0.0, 24.0), between(0.0, 24.0)];
                ground.trees.push((middle, between(1.2, 2.6)));
            }
        }
    }
    let noise = (4.0, SEED + 90 + number);
    let picture = pictured([WINDOW; 2], noise, ground.on(DrawnDay::default()));
    Seen {
        class,
        cells: described(&picture),
        picture,
    }
}

/// Descriptors of the cells: how strong edges are (square root of the mean length of gradients), and what share of
/// them runs in one direction, in the same scale.
fn described(picture: &Gray) -> Vec<Vector2<f64>> {
    let gradient = Gradient::sobel(picture);
    let along = WINDOW / CELL;
    let cell = |index: usize| {
        let (left, top) = (index % along * CELL, index / along * CELL);
        let (mut length, mut doubled) = (0.0, Vector2::zeros());
        for row in top..top + CELL {
            for column in left..left + CELL {
                let (x, y) = (gradient.x.get(column, row), gradient.y.get(column, row));
                let (x, y) = (f64::from(x), f64::from(y));
                let own = x.hypot(y);
                length += own;
                if own > 0.0 {
                    doubled += vector![x * x - y * y, 2.0 * x * y] / own;
                }
            }
        }
        let mean = length / (CELL * CELL) as f64;
        vector![mean.sqrt(), 6.0 * doubled.norm() / length.max(1e-9)]
    };
    (0..along * along).map(cell).collect()
}

fn nearest(words: &[Vector2<f64>], cell: &Vector2<f64>) -> usize {
    let far = |word: &Vector2<f64>| (word - cell).norm_squared();
    let numbered = words.iter().enumerate();
    numbered
        .min_by(|a, b| far(a.1).total_cmp(&far(b.1)))
        .map_or(0, |(index, _)| index)
}

/// Words of the windows to learn from: k-means, from cells that are drawn.
fn vocabulary(count: usize) -> Vec<Vector2<f64>> {
    let cells: Vec<Vector2<f64>> = WINDOWS[0]
        .iter()
        .flat_map(|seen| seen.cells.clone())
        .collect();
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let mut words: Vec<Vector2<f64>> = (0..count)
        .map(|_| cells[random.random_range(0..cells.len())])
        .collect();
    for _ in 0..ROUNDS {
        let mut sums = vec![(Vector2::zeros(), 0.0); count];
        for cell in &cells {
            let (sum, number) = &mut sums[nearest(&words, cell)];
            *sum += cell;
            *number += 1.0;
        }
        for (word, (sum, number)) in words.iter_mut().zip(sums) {
            if number > 0.0 {
                *word = sum / number;
            }
        }
    }
    // In the order of the strength of their edges.
    words.sort_by(|a, b| a.x.total_cmp(&b.x));
    words
}

fn histogram(words: &[Vector2<f64>], seen: &Seen) -> Vec<f64> {
    let mut counts = vec![0.0; words.len()];
    for cell in &seen.cells {
        counts[nearest(words, cell)] += 1.0 / seen.cells.len() as f64;
    }
    counts
}

/// Mean histograms of the classes.
fn learned(words: &[Vector2<f64>]) -> [Vec<f64>; CLASSES] {
    std::array::from_fn(|class| {
        let mut mean = vec![0.0; words.len()];
        for seen in WINDOWS[0].iter().filter(|seen| seen.class == class) {
            for (sum, share) in mean.iter_mut().zip(histogram(words, seen)) {
                *sum += share / EACH as f64;
            }
        }
        mean
    })
}

fn class_of(means: &[Vec<f64>; CLASSES], own: &[f64]) -> usize {
    let far = |mean: &[f64]| -> f64 {
        let pairs = mean.iter().zip(own);
        pairs.map(|(a, b)| (a - b).powi(2)).sum()
    };
    (0..CLASSES)
        .min_by(|a, b| far(&means[*a]).total_cmp(&far(&means[*b])))
        .unwrap_or(0)
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let vocabulary = vocabulary(setting.chosen("words"));
    let means = learned(&vocabulary);
    let mut right = [0.0; CLASSES];
    for seen in &WINDOWS[1] {
        let own = histogram(&vocabulary, seen);
        right[seen.class] += f64::from(u8::from(class_of(&means, &own) == seen.class));
    }
    let judged = (CLASSES as u64 * EACH) as f64;
    let all: f64 = right.iter().sum();
    LessonOutcome {
        figure: draw(&vocabulary, &means, setting.chosen("order") == 1, words),
        values: vec![
            Value::new("words", vocabulary.len() as f64, ""),
            Value::new("right", all, ""),
            Value::new("judged", judged, ""),
            Value::new("share", 100.0 * all / judged, "%"),
            Value::new("buildings", right[0], ""),
            Value::new("fields", right[1], ""),
            Value::new("trees", right[2], ""),
        ],
        checks: vec![Check::at_least("share", 90.0)],
    }
}

fn draw(
    vocabulary: &[Vector2<f64>],
    means: &[Vec<f64>; CLASSES],
    is_mixed: bool,
    words: &Words,
) -> Svg {
    const PIXEL: f64 = 14.0;
    let mut svg = Svg::new(640.0, 460.0);
    let names = ["building", "field", "tree"].map(|name| words.get(name));
    let along = WINDOW / CELL;
    for class in 0..CLASSES {
        let Some(seen) = WINDOWS[1].iter().find(|seen| seen.class == class) else {
            continue;
        };
        let corner = vector![36.0 + 200.0 * class as f64, 30.0];
        let shown = if is_mixed {
            mixed(&seen.picture)
        } else {
            seen.picture.clone()
        };
        // The cells of a mixed window are those of the whole one, elsewhere.
        let shown_cells: Vec<usize> = (0..along * along)
            .map(|index| if is_mixed { mixed_from(index) } else { index })
            .collect();
        let title = corner + vector![84.0, -10.0];
        svg.text(title, TextAnchor::Middle, "small", &names[class]);
        svg.part("window", |svg| {
            draw_picture(svg, &shown.halved(), corner, PIXEL, [40.0, 210.0]);
        });
        svg.part("cells", |svg| {
            for (index, from) in shown_cells.iter().enumerate() {
                let place = vector![(index % along) as f64, (index / along) as f64];
                let low = corner + 3.0 * PIXEL * place;
                svg.rect(low, low.add_scalar(3.0 * PIXEL), "axis");
                let own = &seen.cells[*from];
                let number = (nearest(vocabulary, own) + 1).to_string();
                let middle = low + vector![32.0, 32.0];
                svg.circle(middle, 9.0, "sigma");
                svg.text(
                    middle + vector![0.0, 4.0],
                    TextAnchor::Middle,
                    "small",
                    &number,
                );
            }
        });
        let own = histogram(vocabulary, seen);
        let plot = FigurePlot::new(
            &mut svg,
            [
                vector![200.0 * class as f64 + 4.0, 215.0],
                vector![200.0 * class as f64 + 224.0, 460.0],
            ],
            Axis::new([0.5, vocabulary.len() as f64 + 0.5], words.get("word")),
            Axis::new(
                [0.0, 1.0],
                if class == 0 {
                    words.get("share")
                } else {
                    String::new()
                },
            ),
        );
        svg.part("histogram", |svg| {
            for (word, share) in own.iter().enumerate() {
                let at = word as f64 + 1.0;
                let below = plot.at(at, 0.0) + vector![0.0, 18.0];
                svg.text(below, TextAnchor::Middle, "small", &(word + 1).to_string());
                svg.rect(
                    plot.at(at - 0.35, 0.0),
                    plot.at(at + 0.35, *share),
                    "likelihood",
                );
            }
        });
        svg.part("class", |svg| {
            for (word, share) in means[class].iter().enumerate() {
                let at = word as f64 + 1.0;
                plot.line(svg, &[[at - 0.4, *share], [at + 0.4, *share]], "estimate");
            }
        });
    }
    svg
}

/// Cell of the whole window from which a cell of the mixed one is taken.
fn mixed_from(index: usize) -> usize {
    (index * 7 + 3) % ((WINDOW / CELL) * (WINDOW / CELL))
}

fn mixed(picture: &Gray) -> Gray {
    let along = WINDOW / CELL;
    Gray::from_fn(WINDOW, WINDOW, |column, row| {
        let from = mixed_from(row / CELL * along + column / CELL);
        picture.get(
            from % along * CELL + column % CELL,
            from / along * CELL + row % CELL,
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mixing_uses_each_cell_once() {
        let mut from: Vec<usize> = (0..16).map(mixed_from).collect();
        from.sort_unstable();
        assert_eq!(from, (0..16).collect::<Vec<_>>());
    }

    #[test]
    fn one_word_tells_nothing() {
        let words = vocabulary(1);
        let means = learned(&words);
        assert!(
            WINDOWS[1]
                .iter()
                .all(|seen| class_of(&means, &histogram(&words, seen)) == 0)
        );
    }
}
