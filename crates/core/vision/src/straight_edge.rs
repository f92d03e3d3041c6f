//! Straight edges of a picture: where roofs, roads and fields end.
//!
//! Pixels whose gradients point alike grow together from the strongest on (the idea of LSD, Grompone von Gioi et al.
//! 2010). Strength is measured in what is usual around, so that shadows have edges as well.

use pilotage_raster::raster::{Gradient, Gray, gaussian_blur};
use std::f64::consts::PI;

/// A straight edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StraightEdge {
    /// Its middle (x, y), pixels.
    pub middle: [f64; 2],
    /// Direction, radians clockwise from up, 0 to less than π.
    pub direction: f64,
    /// Length, pixels.
    pub length: f64,
}

/// Standard deviation by which pictures are smoothed, pixels.
const SMOOTHED: f64 = 1.0;
/// Distance from what is not covered at which smoothing no longer sees it, as a standard deviation, pixels.
const FROM_BORDER: f64 = 1.5;
/// Standard deviation of the surroundings that decide what is strong, pixels.
const SURROUNDINGS: f64 = 12.0;
/// Gradient that is noise, grey levels.
const NOISE: f32 = 1.0;
/// Angle by which gradients of one edge differ from their mean, radians.
const ALIKE: f32 = 0.35;
/// Standard deviation across an edge beyond which it is not straight, pixels.
const STRAIGHT: f64 = 1.5;

/// Straight edges at least `least` pixels long of the part of a picture that is `covered` (one, else zero), the
/// strongest first.
pub fn straight_edges(luminance: &Gray, covered: &Gray, least: f64) -> Vec<StraightEdge> {
    let gradient = Gradient::sobel(&gaussian_blur(luminance, SMOOTHED));
    let strength = strength(&gradient, covered);
    let mut left = strength.map(|strength| strength >= 1.0);
    let mut order: Vec<usize> = (0..left.pixels().len())
        .filter(|at| left.pixels()[*at])
        .collect();
    order.sort_by(|a, b| strength.pixels()[*b].total_cmp(&strength.pixels()[*a]));
    let mut found = Vec::new();
    let mut members = Vec::new();
    for start in order {
        if left.pixels()[start] {
            grow(start, &gradient, &mut left, &mut members);
            if members.len() as f64 >= least {
                found.extend(fitted(&members, &strength).filter(|edge| edge.length >= least));
            }
        }
    }
    found
}

/// Length of the gradient over what is usual around; zero near what is not covered.
fn strength(gradient: &Gradient, covered: &Gray) -> Gray {
    let mut strength = gradient.magnitude();
    let near = gaussian_blur(covered, FROM_BORDER);
    for (value, near) in strength.pixels_mut().iter_mut().zip(near.pixels()) {
        if *near < 0.999 {
            *value = 0.0;
        }
    }
    let usual = gaussian_blur(&strength, SURROUNDINGS);
    let cover = gaussian_blur(covered, SURROUNDINGS);
    let around = usual.pixels().iter().zip(cover.pixels());
    for (value, (usual, cover)) in strength.pixels_mut().iter_mut().zip(around) {
        *value /= usual / cover.max(1e-3) + NOISE;
    }
    strength
}

/// Gathers the pixels that are `left`, touch each other and have gradients like that of `start`.
fn grow(
    start: usize,
    gradient: &Gradient,
    left: &mut pilotage_raster::raster::Raster<bool>,
    members: &mut Vec<usize>,
) {
    let (width, height) = (left.width(), left.height());
    let angle = |at: usize| gradient.y.pixels()[at].atan2(gradient.x.pixels()[at]);
    members.clear();
    members.push(start);
    left.pixels_mut()[start] = false;
    let (mut sin_sum, mut cos_sum) = angle(start).sin_cos();
    let mut next = 0;
    while let Some(&at) = members.get(next) {
        next += 1;
        let (column, row) = (at % width, at / width);
        for r in row.saturating_sub(1)..(row + 2).min(height) {
            for c in column.saturating_sub(1)..(column + 2).min(width) {
                let other = r * width + c;
                if !left.pixels()[other] {
                    continue;
                }
                let own = angle(other);
                let (sin, cos) = (own - sin_sum.atan2(cos_sum)).sin_cos();
                if sin.atan2(cos).abs() < ALIKE {
                    left.pixels_mut()[other] = false;
                    members.push(other);
                    let (sin, cos) = own.sin_cos();
                    (sin_sum, cos_sum) = (sin_sum + sin, cos_sum + cos);
                }
            }
        }
    }
}

/// The edge of a set of pixels, if it is straight.
fn fitted(members: &[usize], strength: &Gray) -> Option<StraightEdge> {
    let width = strength.width();
    let place = |at: &usize| [(at % width) as f64 + 0.5, (at / width) as f64 + 0.5];
    let (mut sum, mut first, mut second) = (0.0, [0.0; 2], [0.0; 3]);
    for at in members {
        let weight = f64::from(strength.pixels()[*at]);
        let [x, y] = place(at);
        sum += weight;
        first = [first[0] + weight * x, first[1] + weight * y];
        let products = [x * x, x * y, y * y];
        (0..3).for_each(|k| second[k] += weight * products[k]);
    }
    let [x, y] = first.map(|first| first / sum);
    let [xx, xy, yy] = second.map(|second| second / sum);
    let [xx, xy, yy] = [xx - x * x, xy - x * y, yy - y * y];
    let (sin, cos) = (0.5 * (2.0 * xy).atan2(xx - yy)).sin_cos();
    let across = xx * sin * sin - 2.0 * xy * sin * cos + yy * cos * cos;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for at in members {
        let [px, py] = place(at);
        let along = (px - x) * cos + (py - y) * sin;
        (low, high) = (low.min(along), high.max(along));
    }
    let middle = 0.5 * (low + high);
    (across < STRAIGHT * STRAIGHT).then_some(StraightEdge {
        middle: [x + middle * cos, y + middle * sin],
        direction: cos.atan2(-sin).rem_euclid(PI) % PI,
        length: high - low + 1.0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_4;

    /// A bright square of 30 by 25 pixels around (40, 30), turned clockwise, with a scale of grey beside it.
    fn square(turn: f64) -> Gray {
        let (sin, cos) = turn.sin_cos();
        Gray::from_fn(80, 60, |x, y| {
            let (x, y) = (x as f64 + 0.5 - 40.0, y as f64 + 0.5 - 30.0);
            let (u, v) = (x * cos + y * sin, y * cos - x * sin);
            if u.abs() < 15.0 && v.abs() < 12.5 {
                200.0
            } else {
                50.0 + 0.1 * x as f32
            }
        })
    }

    #[test]
    fn a_square_has_four_edges_as_it_is_turned() {
        let cover = Gray::filled(80, 60, 1.0);
        for turn in [0.0, FRAC_PI_4, 1.2] {
            let edges = straight_edges(&square(turn), &cover, 12.0);
            assert_eq!(edges.len(), 4, "{edges:?}");
            for edge in edges {
                let sides = [(turn, 25.0), (turn + 0.5 * PI, 30.0)].map(|(direction, length)| {
                    let apart = (edge.direction - direction).rem_euclid(PI);
                    apart.min(PI - apart) < 0.04 && (edge.length - length).abs() < 4.0
                });
                assert!(sides[0] || sides[1], "{edge:?} of {turn}");
                let [x, y] = [edge.middle[0] - 40.0, edge.middle[1] - 30.0];
                let off = x.hypot(y);
                assert!(
                    (off - 15.0).abs() < 1.0 || (off - 12.5).abs() < 1.0,
                    "{edge:?}"
                );
            }
        }
    }

    #[test]
    fn the_end_of_what_is_covered_is_no_edge() {
        let picture = Gray::from_fn(80, 60, |x, _| if x < 40 { 150.0 } else { 0.0 });
        let cover = Gray::from_fn(80, 60, |x, _| if x < 40 { 1.0 } else { 0.0 });
        assert_eq!(straight_edges(&picture, &cover, 10.0), []);
    }
}
