//! Data association as a puzzle: the scoreboard of the thesis against pairs that agree.

use nalgebra::{Matrix2, Matrix2x4, Matrix4, Vector2, Vector4, vector};
use pilotage_reference::GenericClass;
use pilotage_reference::association::{
    AssociationProblem, AssociationSettings, CommonError, ObservedLandmark, PossibleLandmark,
    Scoreboard, ScoreboardSettings, associate,
};

use crate::figure::{FigurePlot, Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Height above ground, metres: 1000 feet.
const HEIGHT: f64 = 304.8;
/// Ground in a pixel of the thesis' picture of 1280 pixels, metres.
const PIXEL: f64 = 0.275;
/// Standard deviation of the believed position, metres on each axis.
const BELIEF: f64 = 30.0;
/// Buildings of the map, metres north and east of the ground below the believed position, and their sizes.
const BUILDINGS: [[f64; 3]; 7] = [
    [40.0, -70.0, 12.0],
    [38.0, -40.0, 12.0],
    [42.0, -10.0, 12.0],
    [40.0, 20.0, 12.0],
    [38.0, 50.0, 12.0],
    [-35.0, -30.0, 12.0],
    [-30.0, 45.0, 12.0],
];
/// Trees of the map.
const TREES: [[f64; 3]; 4] = [
    [5.0, -55.0, 8.0],
    [62.0, 5.0, 8.0],
    [-5.0, 30.0, 8.0],
    [-55.0, 10.0, 8.0],
];
/// Buildings and trees of the map that the camera sees, in the order of their letters.
const SEEN: [usize; 7] = [1, 2, 3, 5, 6, 8, 9];
/// Own errors of what is seen, metres north and east.
const ERRORS: [[f64; 2]; 7] = [
    [1.0, -0.8],
    [-1.2, 0.5],
    [0.4, 1.3],
    [-0.6, -1.1],
    [1.4, 0.2],
    [-0.3, 0.9],
    [0.8, -0.4],
];
/// Direction from the believed position to the true one: north and east.
const ASTRAY: [f64; 2] = [0.1, 0.995];

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "which-is-which",
    text: include_str!("../../texts/en/which-is-which.md"),
    controls: &[
        LessonControl::choice("a", 6),
        LessonControl::choice("b", 6),
        LessonControl::choice("c", 6),
        LessonControl::slider("off", [0.0, 45.0], 5.0, 30.0, "m"),
    ],
    compute,
};

fn all_of_map() -> Vec<PossibleLandmark> {
    let of = |class: GenericClass| {
        move |[north, east, size]: &[f64; 3]| PossibleLandmark {
            class,
            place: vector![*north, *east],
            covariance: Matrix2::from_diagonal_element(1.0),
            size: *size,
            detection: 0.8,
        }
    };
    let buildings = BUILDINGS.iter().map(of(GenericClass::Building));
    buildings
        .chain(TREES.iter().map(of(GenericClass::Tree)))
        .collect()
}

/// Change of a place with assumed roll, pitch, yaw and height, of a camera that looks down and heads north.
fn by_pose(place: Vector2<f64>) -> Matrix2x4<f64> {
    let (north, east) = (place.x, place.y);
    Matrix2x4::from_columns(&[
        vector![-north * east / HEIGHT, -HEIGHT - east * east / HEIGHT],
        vector![HEIGHT + north * north / HEIGHT, north * east / HEIGHT],
        vector![-east, north],
        place / HEIGHT,
    ])
}

/// Landmarks that are seen when the aircraft is `off` metres from where it is believed to be.
fn all_seen(map: &[PossibleLandmark], off: f64) -> Vec<ObservedLandmark> {
    let astray = off * Vector2::from(ASTRAY);
    let seen = SEEN.iter().zip(&ERRORS);
    seen.map(|(index, error)| {
        let place = map[*index].place - astray + Vector2::from(*error);
        ObservedLandmark {
            class: map[*index].class,
            place,
            covariance: Matrix2::from_diagonal_element(2.0),
            size: map[*index].size,
            by_pose: by_pose(place),
        }
    })
    .collect()
}

/// Pairs of the scoreboard and of agreement, by what is seen, and the probability of the place by agreement.
struct Paired {
    scoreboard: Vec<Option<usize>>,
    agreeing: Vec<Option<usize>>,
    probability: f64,
    /// Distance of the fix from the truth, metres.
    fix_off: Option<f64>,
}

fn paired(map: &[PossibleLandmark], seen: &[ObservedLandmark], off: f64) -> Paired {
    let board = Scoreboard::of(seen, map, None, &ScoreboardSettings::of_thesis(PIXEL));
    let view = [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]]
        .map(|[north, east]| vector![132.0 * north, 176.0 * east]);
    let angle = 0.3_f64.to_radians().powi(2);
    let problem = AssociationProblem {
        observed: seen,
        possible: map,
        common: CommonError {
            position: Matrix2::from_diagonal_element(BELIEF * BELIEF),
            pose: Matrix4::from_diagonal(&Vector4::new(angle, angle, angle, 4.0)),
        },
        view: &view,
    };
    let found = associate(&problem, &AssociationSettings::default());
    let mut agreeing = vec![None; seen.len()];
    for pair in found.pairs.iter().filter(|pair| pair.accepted) {
        agreeing[pair.observed] = Some(pair.possible);
    }
    let truth = off * Vector2::from(ASTRAY);
    Paired {
        scoreboard: board.rows.iter().map(|row| row.chosen).collect(),
        agreeing,
        probability: found.probability,
        fix_off: found.fix.map(|fix| (fix.offset - truth).norm()),
    }
}

fn right(pairs: &[Option<usize>]) -> f64 {
    let pairs = pairs.iter().zip(&SEEN);
    pairs.filter(|(own, truth)| **own == Some(**truth)).count() as f64
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let off = setting.get("off");
    let map = all_of_map();
    let seen = all_seen(&map, off);
    let pairs = paired(&map, &seen, off);
    // The first choice is none, the others are the buildings 1 to 5.
    let own = ["a", "b", "c"].map(|name| setting.chosen(name).checked_sub(1));
    let board_wrong = pairs.scoreboard.iter().flatten().count() as f64 - right(&pairs.scoreboard);
    LessonOutcome {
        figure: draw(&map, &seen, &own, words),
        values: vec![
            Value::new("off", off, "m"),
            Value::new("yours", right(&own), ""),
            Value::new("seen", SEEN.len() as f64, ""),
            Value::new("scoreboard", right(&pairs.scoreboard), ""),
            Value::new("scoreboard-wrong", board_wrong, ""),
            Value::new("agreeing", right(&pairs.agreeing), ""),
            Value::new("probability", 100.0 * pairs.probability, "%"),
            Value::new("fix-off", pairs.fix_off.unwrap_or(0.0), "m"),
        ],
        checks: vec![Check::at_least("yours", 3.0)],
    }
}

fn draw(
    map: &[PossibleLandmark],
    seen: &[ObservedLandmark],
    own: &[Option<usize>],
    words: &Words,
) -> Svg {
    let mut svg = Svg::new(640.0, 440.0);
    let corners = [vector![0.0, 0.0], vector![640.0, 440.0]];
    let labels = [words.get("east"), words.get("north")];
    let plot = FigurePlot::map(
        &mut svg,
        corners,
        vector![-5.0, 8.0],
        80.0,
        [&labels[0], &labels[1]],
    );
    let square = |svg: &mut Svg, at: Vector2<f64>, half: f64, class: &str| {
        let middle = plot.at(at.y, at.x);
        svg.rect(middle.add_scalar(-half), middle.add_scalar(half), class);
    };
    let mark = |svg: &mut Svg, class: GenericClass, at: Vector2<f64>, style: &str| {
        if class == GenericClass::Tree {
            svg.circle(plot.at(at.y, at.x), 9.0, style);
        } else {
            square(svg, at, 11.0, style);
        }
    };
    svg.part("map", |svg| {
        for (index, thing) in map.iter().enumerate() {
            mark(svg, thing.class, thing.place, "prior");
            if thing.class == GenericClass::Building {
                let at = plot.at(thing.place.y, thing.place.x) + vector![0.0, -16.0];
                svg.text(
                    at,
                    TextAnchor::Middle,
                    "small word-reckoning",
                    &(index + 1).to_string(),
                );
            }
        }
    });
    svg.part("seen", |svg| {
        for (thing, letter) in seen.iter().zip(["A", "B", "C", "D", "E", "", ""]) {
            mark(svg, thing.class, thing.place, "belief");
            let at = plot.at(thing.place.y, thing.place.x) + vector![0.0, 27.0];
            svg.text(at, TextAnchor::Middle, "small word-estimate", letter);
        }
    });
    svg.part("pairs", |svg| {
        for (thing, pair) in seen.iter().zip(own) {
            if let Some(index) = pair {
                let there = map[*index].place;
                let ends = [thing.place, there].map(|at| plot.at(at.y, at.x));
                svg.line(ends[0], ends[1], "truth");
            }
        }
    });
    plot.key(
        &mut svg,
        &[
            (&words.get("map"), "small word-reckoning"),
            (&words.get("seen"), "small word-estimate"),
        ],
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_that_agree_are_right_however_far_the_position_is_off() {
        let map = all_of_map();
        for off in [0.0, 15.0, 30.0, 45.0] {
            let pairs = paired(&map, &all_seen(&map, off), off);
            assert!((right(&pairs.agreeing) - 7.0).abs() < 0.5, "{off}");
            assert!(pairs.fix_off.unwrap() < 1.0);
        }
    }
}
