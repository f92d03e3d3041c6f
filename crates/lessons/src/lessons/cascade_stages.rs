//! A cascade, trained here and now, stage by stage.

use std::sync::LazyLock;

use nalgebra::vector;
use pilotage_raster::raster::Raster;
use pilotage_vision::landmark::cascade::train::{
    CascadeTraining, FeatureKind, StageGoal, TrainingSettings,
};
use pilotage_vision::landmark::cascade::{Cascade, Patch, responses, stage_features, trace};

use crate::figure::{Axis, FigurePlot, Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{DrawnDay, DrawnGround, House, draw_box, draw_picture, pictured};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Side of the cascade's window, pixels.
const WINDOW: usize = 10;
/// Examples of the landmark, and of other ground.
const EXAMPLES: u64 = 40;
const OTHERS: u64 = 30;
/// Most windows of other ground that a stage is shown.
const SHOWN: usize = 160;
/// Most stages, and most votes of the first; the second has twice as many, and so on.
const STAGES: usize = 4;
const VOTES: usize = 2;
/// Fewest windows of other ground that are left for another stage.
const FEWEST: usize = 5;
/// Size of the searched picture, pixels, and the middle of the landmark in it.
const SIZE: [usize; 2] = [38, 30];
const LANDMARK: [f64; 2] = [24.0, 13.0];
/// Seed of everything that is drawn.
const SEED: u64 = 7;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "cascade-stages",
    text: include_str!("../../texts/en/cascade-stages.md"),
    controls: &[LessonControl::slider(
        "stages",
        [1.0, STAGES as f64],
        1.0,
        1.0,
        "",
    )],
    compute,
};

/// Landmark of two wings around a place.
fn landmark([x, y]: [f64; 2]) -> Vec<House> {
    vec![
        House {
            middle: [x - 1.5, y],
            half: [1.5, 4.0],
        },
        House {
            middle: [x + 1.5, y + 2.5],
            half: [2.5, 1.5],
        },
    ]
}

fn others(shift: f64) -> Vec<House> {
    vec![
        House {
            middle: [8.0 + shift, 7.0],
            half: [3.0, 2.0],
        },
        House {
            middle: [10.0, 22.0 + shift],
            half: [2.0, 3.5],
        },
        House {
            middle: [32.0 - shift, 25.0],
            half: [3.0, 1.5],
        },
    ]
}

fn bytes(size: [usize; 2], noise: u64, ground: &DrawnGround) -> Raster<u8> {
    pictured(size, (5.0, noise), ground.on(DrawnDay::default()))
        .map(|grey| grey.clamp(0.0, 255.0) as u8)
}

fn searched() -> DrawnGround {
    let mut houses = others(0.0);
    houses.extend(landmark(LANDMARK));
    DrawnGround {
        houses,
        trees: vec![
            ([17.0, 5.0], 2.0),
            ([30.0, 6.0], 1.5),
            ([19.0, 24.0], 2.5),
            ([35.0, 15.0], 1.8),
        ],
        texture: 8.0,
        seed: SEED,
        ..DrawnGround::default()
    }
}

/// Windows with their groups of which the training is made.
fn examples() -> Vec<(Patch, usize)> {
    let side = WINDOW + 2;
    let window = |example: u64| {
        let near = |k: u64| ((example * k) % 7) as f64 / 7.0 - 0.43;
        let middle = side as f64 / 2.0;
        let ground = DrawnGround {
            houses: landmark([middle + near(3), middle + near(5)]),
            texture: 8.0,
            seed: SEED + 100 + example,
            ..DrawnGround::default()
        };
        Patch::with_margin(bytes([side; 2], SEED + example, &ground))
    };
    (0..EXAMPLES).filter_map(window).zip(0..).collect()
}

/// Pictures of other ground.
fn other_pictures() -> Vec<Raster<u8>> {
    let picture = |number: u64| {
        let shift = number as f64 * 0.28 - 4.0;
        let ground = DrawnGround {
            houses: others(shift),
            trees: vec![
                ([14.0 + shift, 8.0], 2.0),
                ([26.0 - shift, 16.0], 1.5),
                ([20.0, 23.0 + 0.5 * shift], 2.5),
                ([34.0, 12.0 + shift], 1.8),
            ],
            texture: 8.0,
            seed: SEED + 500 + number,
            ..DrawnGround::default()
        };
        bytes(SIZE, SEED + 900 + number, &ground)
    };
    (0..OTHERS).map(picture).collect()
}

/// Windows of other ground, with their groups, that a cascade lets pass though it should not.
fn let_pass(cascade: Option<&Cascade>, pictures: &[Raster<u8>]) -> Vec<(Patch, usize)> {
    let mut passed = Vec::new();
    for (group, picture) in pictures.iter().enumerate() {
        let stages =
            cascade.map(|cascade| (responses(cascade, picture).stages, cascade.stages.len()));
        for row in 0..=SIZE[1] - WINDOW {
            for column in 0..=SIZE[0] - WINDOW {
                let is_in = stages
                    .as_ref()
                    .is_none_or(|(passed, all)| usize::from(passed.get(column, row)) == *all);
                if is_in {
                    passed.push((column, row, group));
                }
            }
        }
    }
    let each = passed.len().div_ceil(SHOWN).max(1);
    let chosen = passed.into_iter().step_by(each);
    chosen
        .filter_map(|(column, row, group)| {
            let patch = Patch::cut(&pictures[group], column, row, WINDOW, WINDOW)?;
            Some((patch, group))
        })
        .collect()
}

/// Cascades of one stage, two, and so on.
fn trained() -> Option<Vec<Cascade>> {
    let settings = TrainingSettings {
        kind: FeatureKind::Hog,
        width: WINDOW,
        height: WINDOW,
        seed: SEED,
    };
    let mut training = CascadeTraining::new(settings, examples());
    let pictures = other_pictures();
    let mut cascades: Vec<Cascade> = Vec::new();
    for stage in 1..=STAGES {
        let left = let_pass(cascades.last(), &pictures);
        if left.len() < FEWEST {
            break;
        }
        let goal = StageGoal {
            hit_rate: 0.99,
            false_alarm_rate: 0.4,
            most_votes: VOTES * stage,
        };
        training.begin_stage(&left, goal).ok()?;
        while training.vote().is_none() {}
        cascades.push(training.cascade().ok()??);
    }
    Some(cascades)
}

static CASCADES: LazyLock<Vec<Cascade>> = LazyLock::new(|| trained().unwrap_or_default());

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let stages = setting.chosen("stages").clamp(1, CASCADES.len().max(1));
    let picture = bytes(SIZE, SEED + 40, &searched());
    let Some(cascade) = CASCADES.get(stages - 1) else {
        return LessonOutcome {
            figure: Svg::new(640.0, 400.0),
            values: Vec::new(),
            checks: Vec::new(),
        };
    };
    let traced = trace(cascade, &picture, 1.0);
    // A vote asks one feature.
    let votes: Vec<usize> = (0..stages)
        .map(|stage| stage_features(cascade, stage).len())
        .collect();
    let asked: usize = traced
        .left
        .iter()
        .zip(&votes)
        .map(|(left, votes)| left * votes)
        .sum();
    let all = traced.left.first().copied().unwrap_or(0);
    let last = traced.left.last().copied().unwrap_or(0);
    let right = (0..traced.ended.height())
        .flat_map(|row| (0..traced.ended.width()).map(move |column| (column, row)))
        .filter(|(column, row)| usize::from(traced.ended.get(*column, *row)) == stages)
        .filter(|(column, row)| is_right(*column, *row))
        .count();
    LessonOutcome {
        figure: draw(&picture, &traced, stages, words),
        values: vec![
            Value::new("stages", stages as f64, ""),
            Value::new("windows", all as f64, ""),
            Value::new("left", last as f64, ""),
            Value::new("left-share", 100.0 * last as f64 / all.max(1) as f64, "%"),
            Value::new("votes", votes.iter().sum::<usize>() as f64, ""),
            Value::new("asked", asked as f64 / all.max(1) as f64, ""),
            Value::new("false", (last - right) as f64, ""),
            Value::new("five", 100.0 * 0.4_f64.powi(5), "%"),
            Value::new("kept", 100.0 * 0.99_f64.powi(5), "%"),
        ],
        checks: vec![Check::at_most("false", 0.0), Check::at_least("left", 1.0)],
    }
}

/// Whether a window is the landmark's, but for three pixels and a half.
fn is_right(column: usize, row: usize) -> bool {
    let middle = WINDOW as f64 / 2.0;
    let [x, y] = LANDMARK;
    (column as f64 + middle - x).hypot(row as f64 + middle - y) <= 3.5
}

fn draw(
    picture: &Raster<u8>,
    traced: &pilotage_vision::landmark::cascade::Trace,
    stages: usize,
    words: &Words,
) -> Svg {
    const PIXEL: f64 = 10.0;
    let mut svg = Svg::new(640.0, 400.0);
    let corner = vector![10.0, 44.0];
    draw_picture(
        &mut svg,
        &picture.map(f32::from),
        corner,
        PIXEL,
        [40.0, 210.0],
    );
    let place = |column: usize, row: usize| {
        corner + PIXEL * vector![column as f64, row as f64].add_scalar(WINDOW as f64 / 2.0)
    };
    svg.part("left", |svg| {
        for row in 0..traced.ended.height() {
            for column in 0..traced.ended.width() {
                if usize::from(traced.ended.get(column, row)) == stages {
                    svg.circle(place(column, row), 3.0, "dot-estimate");
                }
            }
        }
    });
    svg.part("landmark", |svg| {
        let side = WINDOW as f64;
        let area = [
            LANDMARK[0] - side / 2.0,
            LANDMARK[1] - side / 2.0,
            side,
            side,
        ];
        draw_box(svg, corner, PIXEL, area, "truth");
    });
    svg.text(
        vector![10.0, 18.0],
        TextAnchor::Start,
        "small word-estimate",
        &words.get("left"),
    );
    svg.text(
        vector![10.0, 36.0],
        TextAnchor::Start,
        "small word-truth",
        &words.get("landmark"),
    );
    let most = traced.left.first().copied().unwrap_or(1) as f64;
    let plot = FigurePlot::new(
        &mut svg,
        [vector![400.0, 30.0], vector![640.0, 390.0]],
        Axis::new([-0.5, STAGES as f64 + 0.5], words.get("stage")),
        Axis::new([0.0, 3.0], words.get("log")),
    );
    for stage in 1..=STAGES {
        let below = plot.at(stage as f64, 0.0) + vector![0.0, 18.0];
        svg.text(below, TextAnchor::Middle, "small", &stage.to_string());
    }
    svg.part("bars", |svg| {
        for (stage, left) in traced.left.iter().enumerate() {
            let height = (*left as f64).max(1.0).log10().max(0.02);
            let (from, to) = (stage as f64 - 0.35, stage as f64 + 0.35);
            svg.rect(
                plot.at(from, 0.0),
                plot.at(to, height.min(most.log10())),
                "likelihood",
            );
            plot.text(
                svg,
                [stage as f64, height + 0.06],
                TextAnchor::Middle,
                "small",
                &left.to_string(),
            );
        }
    });
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stages_of_a_longer_cascade_begin_with_those_of_a_shorter_one() {
        let picture = bytes(SIZE, SEED + 40, &searched());
        let left: Vec<Vec<usize>> = CASCADES
            .iter()
            .map(|c| trace(c, &picture, 1.0).left)
            .collect();
        assert!(!left.is_empty());
        for pair in left.windows(2) {
            assert_eq!(pair[0][..], pair[1][..pair[0].len()]);
        }
    }
}
