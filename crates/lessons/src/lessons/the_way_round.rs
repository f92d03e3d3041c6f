//! The way round: a longer way over landmarks against the straight one.

use nalgebra::{Vector2, vector};
use pilotage_base::statistics::normal_probability;

use crate::figure::{FigurePlot, Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{RouteBelief, SPEED};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Metres from start to goal, which lies to the east.
const STRAIGHT: f64 = 10_000.0;
/// Landmarks to the left of the straight way, east and north, metres.
const LANDMARKS: [Vector2<f64>; 3] = [
    Vector2::new(3000.0, 1500.0),
    Vector2::new(5000.0, 1500.0),
    Vector2::new(7000.0, 1500.0),
];
/// Half of the ground that the camera sees across the way, metres.
const SEEN: f64 = 170.0;
/// Deviation of a look, metres; that of the place (metres) and of the wind (m/s) at the start.
const LOOK: f64 = 5.0;
const START: (f64, f64) = (5.0, 0.5);

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "the-way-round",
    text: include_str!("../../texts/en/the-way-round.md"),
    controls: &[
        LessonControl::slider("aside", [0.0, 2500.0], 100.0, 0.0, "m"),
        LessonControl::slider("wind", [0.5, 4.0], 0.5, 0.5, "m/s"),
    ],
    compute,
};

/// Length, looks and error that are expected of a way.
struct Expected {
    length: f64,
    /// Probability that each landmark comes into the picture.
    seen: [f64; 3],
    /// Root of the mean square of the error at the goal, over all that may be seen, metres.
    goal: f64,
}

/// The way: out to the side, past the landmarks, back.
fn way(aside: f64) -> [Vector2<f64>; 5] {
    let [a, b, c] = LANDMARKS.map(|it| vector![it.x, aside]);
    [vector![0.0, 0.0], a, b, c, vector![STRAIGHT, 0.0]]
}

/// Every world of landmarks that were seen or not, with its probability: flown once, and cut in two at each landmark.
fn expected(aside: f64, wind: f64) -> Option<Expected> {
    let points = way(aside);
    let mut worlds = vec![(1.0, RouteBelief::new(START.0, wind)?)];
    let mut length = 0.0;
    let mut seen = [0.0; 3];
    for (index, pair) in points.windows(2).enumerate() {
        let leg = pair[1] - pair[0];
        length += leg.norm();
        let heading = leg.x.atan2(leg.y);
        for (_, belief) in &mut worlds {
            belief.fly(heading, leg.norm() / SPEED);
        }
        let Some(landmark) = LANDMARKS.get(index) else {
            break;
        };
        let beside = landmark.y - aside;
        let mut cut = Vec::with_capacity(2 * worlds.len());
        for (weight, belief) in worlds {
            // The landmarks lie in a row to the east, so that north is across.
            let across = belief.state().standard_deviations()[0];
            let below = |edge: f64| normal_probability((edge + beside) / across);
            let chance = below(SEEN) - below(-SEEN);
            seen[index] += weight * chance;
            let mut looked = belief.clone();
            looked.look(LOOK)?;
            cut.push((weight * (1.0 - chance), belief));
            cut.push((weight * chance, looked));
        }
        worlds = cut;
    }
    let square: f64 = worlds
        .iter()
        .map(|(weight, belief)| weight * belief.error().powi(2))
        .sum();
    Some(Expected {
        length,
        seen,
        goal: square.sqrt(),
    })
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (aside, wind) = (setting.get("aside"), setting.get("wind"));
    let nothing = || Expected {
        length: f64::NAN,
        seen: [f64::NAN; 3],
        goal: f64::NAN,
    };
    let own = expected(aside, wind).unwrap_or_else(nothing);
    let straight = expected(0.0, wind).unwrap_or_else(nothing);
    LessonOutcome {
        figure: draw(aside, &own, words),
        values: vec![
            Value::new("aside", aside, "m"),
            Value::new("wind", wind, "m/s"),
            Value::new("length", own.length / 1000.0, "km"),
            Value::new("longer", 100.0 * (own.length / STRAIGHT - 1.0), "%"),
            Value::new("first", 100.0 * own.seen[0], "%"),
            Value::new("goal", own.goal, "m"),
            Value::new("straight", straight.goal, "m"),
        ],
        checks: vec![Check::at_most("goal", 150.0), Check::at_most("longer", 7.5)],
    }
}

/// Line beside a way through points, so many metres to the left of each of its pieces.
fn beside(points: &[Vector2<f64>], left: f64) -> Vec<[f64; 2]> {
    let normals: Vec<Vector2<f64>> = points
        .windows(2)
        .map(|ends| (ends[1] - ends[0]).normalize())
        .map(|along| vector![-along.y, along.x])
        .collect();
    let last = normals.len() - 1;
    let corner = |(index, at): (usize, &Vector2<f64>)| {
        let (before, after) = (normals[index.saturating_sub(1)], normals[index.min(last)]);
        // The bisector, so long that both pieces keep their distance.
        let place = at + left * (before + after) / (1.0 + before.dot(&after));
        [place.x, place.y]
    };
    points.iter().enumerate().map(corner).collect()
}

fn draw(aside: f64, own: &Expected, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 340.0);
    let plot = FigurePlot::whole_map(
        &mut svg,
        vector![5200.0, 800.0],
        2700.0,
        [&words.get("east"), &words.get("north")],
    );
    let points = way(aside);
    svg.part("seen", |svg| {
        let side = |aside: f64| beside(&points, aside);
        let outline: Vec<[f64; 2]> = (side(SEEN).into_iter())
            .chain(side(-SEEN).into_iter().rev())
            .collect();
        plot.area(svg, &outline, "shade");
    });
    svg.part("straight", |svg| {
        plot.line(svg, &[[0.0, 0.0], [STRAIGHT, 0.0]], "reckoning");
    });
    svg.part("way", |svg| {
        let line: Vec<[f64; 2]> = points.iter().map(|at| [at.x, at.y]).collect();
        plot.line(svg, &line, "estimate");
    });
    svg.part("landmarks", |svg| {
        for (landmark, chance) in LANDMARKS.iter().zip(own.seen) {
            let at = plot.at(landmark.x, landmark.y);
            svg.circle(at, 6.0, "landmark");
            let words = format!("{:.0} %", 100.0 * chance);
            svg.text(
                at - vector![0.0, 14.0],
                TextAnchor::Middle,
                "word-look",
                &words,
            );
        }
    });
    svg.part("goal", |svg| {
        let radius = plot.length(own.goal);
        let goal = plot.at(STRAIGHT, 0.0);
        svg.circle(goal, radius, "belief");
        svg.circle(goal, 4.0, "dot-estimate");
    });
    plot.key(
        &mut svg,
        &[
            (&words.get("way"), "word-estimate"),
            (&words.get("straight"), "word-reckoning"),
            (&words.get("chance"), "word-look"),
        ],
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_strip_keeps_its_distance_from_each_piece_of_the_way() {
        let way = [vector![0.0, 0.0], vector![3.0, 4.0], vector![9.0, 4.0]];
        let left: Vec<_> = beside(&way, 2.0).into_iter().map(Vector2::from).collect();
        for (ends, moved) in way.windows(2).zip(left.windows(2)) {
            let along = (ends[1] - ends[0]).normalize();
            for (from, to) in ends.iter().zip(moved) {
                assert!((along.perp(&(to - from)) - 2.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn over_the_landmarks_each_is_seen_and_far_from_them_none() {
        let over = expected(1500.0, 0.5).unwrap();
        assert!(over.seen.iter().all(|chance| *chance > 0.85));
        let wanted = 2.0 * 3000f64.hypot(1500.0) + 4000.0;
        assert!((over.length - wanted).abs() < 1e-6);
        assert!(expected(0.0, 0.5).unwrap().seen.iter().all(|it| *it < 1e-6));
    }
}
