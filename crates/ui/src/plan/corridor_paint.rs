//! The predicted corridor on the map.

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
    fn at(view: &ScreenFromWorld, sample: &PredictionSample) -> Self {
        let (sin, cos) = sample.course.sin_cos();
        let across = sample.corridor.across;
        let widest = f64::from(WIDEST / view.points(1.0));
        let half = across.min(widest);
        let p = sample.position;
        let side = |half: f64| GroundPoint::new(p.north - half * sin, p.east + half * cos);
        Self {
            sides: [-half, half].map(|half| view.apply(&side(half))),
            is_cut: across > widest,
        }
    }
}

/// Pieces across the whole corridor.
fn across(view: &ScreenFromWorld, samples: &[PredictionSample]) -> Vec<Across> {
    samples.iter().map(|s| Across::at(view, s)).collect()
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

    #[test]
    fn a_corridor_of_kilometres_does_not_cover_the_map() {
        let view = ScreenFromWorld {
            center: GroundPoint::default(),
            metres_per_point: 0.5,
            up: 0.3,
            middle: Pos2::new(400.0, 300.0),
        };
        let sample = |sigma: f64| {
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
        };
        let per_metre = f64::from(view.points(1.0));
        let narrow = Across::at(&view, &sample(20.0 / per_metre));
        let wide = Across::at(&view, &sample(5e4 / per_metre));
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
