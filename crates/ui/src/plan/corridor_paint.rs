//! The predicted corridor on the map.

use std::f64::consts::{PI, TAU};

use egui::epaint::{Mesh, Vertex, WHITE_UV};
use egui::{Color32, Painter, Pos2, Shape, Stroke};
use pilotage_core::frames::GroundPoint;
use pilotage_core::plan::{PredictionSample, RoutePrediction};

use crate::map::{ScreenFromWorld, ellipse};
use crate::tokens::Tokens;

/// Distance between ellipses along the path, points.
const ELLIPSE_SPACING: f32 = 96.0;
/// Greatest half width that is drawn, points. A corridor of kilometres would cover the map with one leg
/// over the other and say no more; where it is wider it has no edge.
const WIDEST: f32 = 140.0;

/// Least change of course between two samples that is a bend, rad.
const LEAST_TURN: f64 = 1e-3;

/// The corridor's colour where the limit is kept.
pub fn kept_color(tokens: &Tokens) -> Color32 {
    tokens.observed
}

/// A piece across the corridor on the screen.
struct Across {
    sides: [Pos2; 2],
    /// Whether it is wider than what is drawn.
    is_cut: bool,
}

impl Across {
    fn at(view: &ScreenFromWorld, sample: &PredictionSample, most: [f64; 2]) -> Self {
        let widest = f64::from(WIDEST / view.points(1.0));
        let sides = corridor_sides(sample, most.map(|most| most.min(widest)));
        Self {
            sides: sides.map(|side| view.apply(&side)),
            is_cut: sample.corridor.across > widest,
        }
    }
}

/// Places at the left and the right edge of the corridor beside a sample, at most so far from it, metres.
pub(super) fn corridor_sides(sample: &PredictionSample, most: [f64; 2]) -> [GroundPoint; 2] {
    let (sin, cos) = sample.course.sin_cos();
    let [left, right] = most.map(|most| most.min(sample.corridor.across));
    let at = sample.position;
    [-left, right].map(|half| GroundPoint::new(at.north - half * sin, at.east + half * cos))
}

/// Room at the left and the right of each sample in which the pieces across do not cross each other, metres: on the
/// inner side of a bend up to its middle.
pub(super) fn room_beside(samples: &[PredictionSample]) -> Vec<[f64; 2]> {
    let last = samples.len().saturating_sub(1);
    let room = |index: usize| {
        let [before, after] =
            [index.saturating_sub(1), last.min(index + 1)].map(|index| &samples[index]);
        let turn = (after.course - before.course + PI).rem_euclid(TAU) - PI;
        let radius = (after.distance - before.distance) / turn.abs();
        match turn {
            turn if turn < -LEAST_TURN => [radius, f64::INFINITY],
            turn if turn > LEAST_TURN => [f64::INFINITY, radius],
            _ => [f64::INFINITY; 2],
        }
    };
    (0..samples.len()).map(room).collect()
}

/// Pieces across the whole corridor.
fn across(view: &ScreenFromWorld, samples: &[PredictionSample]) -> Vec<Across> {
    let rooms = room_beside(samples).into_iter().zip(samples);
    rooms.map(|(room, s)| Across::at(view, s, room)).collect()
}

/// A band over the pieces, each part coloured as the piece at its end.
fn band(pieces: &[Across], color: impl Fn(usize) -> Color32) -> Shape {
    let mut mesh = Mesh::default();
    for (end, pair) in (1..).zip(pieces.windows(2)) {
        let [a, b] = [pair[0].sides, pair[1].sides];
        let first = mesh.vertices.len() as u32;
        for pos in [a[0], a[1], b[1], b[0]] {
            mesh.vertices.push(Vertex {
                pos,
                uv: WHITE_UV,
                color: color(end),
            });
        }
        mesh.add_triangle(first, first + 1, first + 2);
        mesh.add_triangle(first, first + 2, first + 3);
    }
    Shape::mesh(mesh)
}

/// A band along the flown path, as wide as the 95 % corridor.
pub(super) fn corridor_band(
    view: &ScreenFromWorld,
    prediction: &RoutePrediction,
    color: Color32,
) -> Shape {
    band(&across(view, &prediction.samples), |_| color)
}

/// Draws the 95 % corridor along the flown path: a band, its edges, and ellipses at intervals.
pub(super) fn paint_corridor(
    painter: &Painter,
    view: &ScreenFromWorld,
    prediction: &RoutePrediction,
    limit: f64,
    tokens: &Tokens,
) {
    let over = |s: &PredictionSample| s.corridor.sigma_major > limit;
    let color = |over: bool| {
        if over {
            tokens.warning
        } else {
            kept_color(tokens)
        }
    };
    let samples = &prediction.samples;
    let pieces = across(view, samples);
    painter.add(band(&pieces, |i| {
        color(over(&samples[i])).gamma_multiply(0.26)
    }));
    let mut begin = 0;
    let alike = |a: usize, b: usize| {
        over(&samples[a]) == over(&samples[b]) && pieces[a].is_cut == pieces[b].is_cut
    };
    while begin < samples.len() {
        let same = (begin..samples.len()).take_while(|i| alike(begin, *i));
        let next = begin + same.count();
        if !pieces[begin].is_cut {
            // On to the next piece, unless that has no edge.
            let reached = pieces.get(next).is_some_and(|piece| !piece.is_cut);
            let end = next + usize::from(reached);
            paint_edges(
                painter,
                &pieces[begin..end],
                color(over(&samples[begin])),
                over(&samples[begin]),
            );
        }
        begin = next;
    }
    let mut last: Option<Pos2> = None;
    for (sample, piece) in samples.iter().zip(&pieces) {
        let at = view.apply(&sample.position);
        if piece.is_cut || last.is_some_and(|last| last.distance(at) < ELLIPSE_SPACING) {
            continue;
        }
        last = Some(at);
        let c = &sample.corridor;
        if let Some(points) = ellipse(view, &sample.position, &c.covariance, c.scale) {
            let stroke = Stroke::new(1.0, color(over(sample)).gamma_multiply(0.8));
            painter.add(Shape::closed_line(points, stroke));
        }
    }
}

fn paint_edges(painter: &Painter, pieces: &[Across], color: Color32, is_dashed: bool) {
    for side in 0..2 {
        let line: Vec<Pos2> = pieces.iter().map(|piece| piece.sides[side]).collect();
        if is_dashed {
            let stroke = Stroke::new(2.0, color);
            painter.extend(Shape::dashed_line(&line, stroke, 6.0, 4.0));
        } else {
            painter.add(Shape::line(line, Stroke::new(1.25, color)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::plan::{WorldError, corridor};

    fn sample(sigma: f64) -> PredictionSample {
        let world = WorldError {
            weight: 1.0,
            mean: nalgebra::Vector2::zeros(),
            covariance: nalgebra::Matrix2::identity() * sigma * sigma,
        };
        PredictionSample {
            time: 0.0,
            distance: 0.0,
            position: GroundPoint::default(),
            course: 0.6,
            corridor: corridor(&[world], 0.6, 0.95).unwrap(),
            detection: Vec::new(),
            dead_reckoning: 0.0,
        }
    }

    #[test]
    fn a_wide_corridor_around_a_bend_does_not_cross_itself() {
        // A right turn of 60 m radius from north to east, about a middle 60 m east of where it begins.
        let bend = (0..=20).map(|step| {
            let course = f64::from(step) / 20.0 * 0.5 * PI;
            let (sin, cos) = course.sin_cos();
            PredictionSample {
                distance: 60.0 * course,
                position: GroundPoint::new(60.0 * sin, 60.0 - 60.0 * cos),
                course,
                ..sample(200.0)
            }
        });
        let bend: Vec<_> = bend.collect();
        let rooms = room_beside(&bend);
        let middle = GroundPoint::new(0.0, 60.0);
        for (sample, room) in bend.iter().zip(rooms) {
            let [left, right] = corridor_sides(sample, room);
            assert!(right.distance(&middle) < 1.0, "{right:?}");
            assert!((left.distance(&middle) - 60.0 - sample.corridor.across).abs() < 1.0);
        }
        let across = room_beside(&[sample(9.0), sample(9.0)]);
        assert_eq!(across, [[f64::INFINITY; 2]; 2], "straight on");
    }

    #[test]
    fn a_corridor_of_kilometres_does_not_cover_the_map() {
        let view = ScreenFromWorld {
            center: GroundPoint::default(),
            metres_per_point: 0.5,
            up: 0.3,
            middle: Pos2::new(400.0, 300.0),
        };
        let per_metre = f64::from(view.points(1.0));
        let free = [f64::INFINITY; 2];
        let narrow = Across::at(&view, &sample(20.0 / per_metre), free);
        let wide = Across::at(&view, &sample(5e4 / per_metre), free);
        let width = |a: &Across| a.sides[0].distance(a.sides[1]);
        assert!(!narrow.is_cut && wide.is_cut);
        assert!(
            (width(&narrow) - 2.0 * 1.96 * 20.0).abs() < 1.0,
            "{}",
            width(&narrow)
        );
        assert!(
            (width(&wide) - 2.0 * WIDEST).abs() < 0.1,
            "{}",
            width(&wide)
        );
    }
}
