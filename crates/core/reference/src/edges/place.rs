//! The place of a picture by all of its edges.

use nalgebra::{Matrix2, Vector2};
use std::f64::consts::PI;

use super::field::{CELL, DIRECTIONS, EdgeField};
use crate::GenericLandmark;
use pilotage_base::frames::GroundPoint;

/// Belief about a picture before its edges are looked at; the place is that of its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgePrior {
    /// Ground that the assumed pose has in the middle of the picture.
    pub middle: GroundPoint,
    /// Standard deviation of that, metres per axis.
    pub deviation: f64,
    /// Farthest that the assumed heading is off, radians.
    pub turn: f64,
    /// Standard deviation of the logarithm of the true height over the assumed one.
    pub log_height: f64,
    /// Standard deviation of the map's own places, metres per axis.
    pub map_deviation: f64,
}

/// Place of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgePlace {
    /// Ground in its middle.
    pub middle: GroundPoint,
    /// Covariance of that, square metres.
    pub covariance: Matrix2<f64>,
    /// Probability that the picture lies there, against all other places that are tried and against chance.
    pub probability: f64,
}

/// Distance of places that are tried, metres.
const STEP: f64 = 2.0;
/// Most that the heading changes from one trial to the next, radians.
const TURN: f64 = 0.03;
/// Logarithms of scales that are tried to each side.
const SCALES: i32 = 4;
/// Farthest place and scale that are tried, standard deviations.
pub(super) const FARTHEST: f64 = 2.8;
/// Edges of a roof are not independent, nor are roofs: what they say together is so many times weaker than their sum.
const TEMPERATURE: f64 = 3.0;
/// Length of an edge that counts as one, metres; others count as the root of their length over that.
const USUAL_LENGTH: f64 = 10.0;
/// Distance along an edge of places that are looked up, metres, and the least number of them.
const LOOKED_UP: f64 = 2.0;
const LEAST_LOOKED_UP: usize = 3;
/// Places at most so far from the likeliest one are the same, metres.
const SAME: f64 = 8.0;

/// Place of a picture whose edges lie as `seen` by its assumed pose; `None` where no edge was seen.
///
/// Every place, heading and scale that the belief allows is tried, and weighed by the belief times how much likelier
/// the table makes the edges than chance. The errors of roll and pitch are in the place of the middle.
pub fn place_by_edges(
    seen: &[GenericLandmark],
    prior: &EdgePrior,
    field: &EdgeField,
) -> Option<EdgePlace> {
    if seen.is_empty() {
        return None;
    }
    let reach = (FARTHEST * prior.deviation / STEP).ceil() as i32;
    let side = (2 * reach + 1) as usize;
    let turns = (prior.turn / TURN).ceil() as i32;
    let mut trials: Vec<f64> = Vec::new();
    let mut log_sum = vec![0.0_f32; side * side];
    for turn in -turns..=turns {
        let yaw = f64::from(turn) * prior.turn / f64::from(turns.max(1));
        for scale in -SCALES..=SCALES {
            let grown = (deviations(scale) * prior.log_height).exp();
            log_sum.fill(0.0);
            for edge in seen {
                add(&mut log_sum, edge, prior.middle, (yaw, grown), field, reach);
            }
            trials.extend(log_sum.iter().map(|sum| f64::from(*sum) / TEMPERATURE));
        }
    }
    let shift = |trial: usize| {
        let place = (trial % (side * side)) as i32;
        let (row, column) = (place / side as i32 - reach, place % side as i32 - reach);
        Vector2::new(f64::from(-row), f64::from(column)) * STEP
    };
    let believed = |trial: usize| {
        let scale = (trial / (side * side)) as i32 % (2 * SCALES + 1) - SCALES;
        let place = shift(trial).norm_squared() / prior.deviation.powi(2);
        -0.5 * (place + deviations(scale).powi(2))
    };
    let (mut likeliest, mut top) = (0, f64::NEG_INFINITY);
    for (trial, log) in trials.iter().enumerate() {
        let log = log + believed(trial);
        if log > top {
            (likeliest, top) = (trial, log);
        }
    }
    let likeliest = shift(likeliest);
    let (mut all, mut here, mut chance) = (0.0, 0.0, 0.0);
    let (mut first, mut second) = (Vector2::zeros(), Matrix2::zeros());
    for (trial, log) in trials.iter().enumerate() {
        let (shift, before) = (shift(trial), believed(trial));
        let weight = (log + before - top).exp();
        all += weight;
        chance += before.exp();
        if (shift - likeliest).norm() <= SAME {
            here += weight;
            first += shift * weight;
            second += shift * shift.transpose() * weight;
        }
    }
    let mean = first / here;
    let own = STEP * STEP / 12.0 + prior.map_deviation.powi(2);
    Some(EdgePlace {
        middle: GroundPoint::from(prior.middle.to_vector() + mean),
        covariance: second / here - mean * mean.transpose() + Matrix2::identity() * own,
        probability: here / (all + chance * (-top).exp()),
    })
}

/// Standard deviations by which a scale that is tried is off.
fn deviations(scale: i32) -> f64 {
    FARTHEST * f64::from(scale) / f64::from(SCALES)
}

/// Adds what the field says of an edge to the sum of every shift, row by row from the north.
fn add(
    log_sum: &mut [f32],
    edge: &GenericLandmark,
    middle: GroundPoint,
    (yaw, grown): (f64, f64),
    field: &EdgeField,
    reach: i32,
) {
    let (sin, cos) = yaw.sin_cos();
    let away = edge.place.to_vector() - middle.to_vector();
    let turned = Vector2::new(away.x * cos - away.y * sin, away.x * sin + away.y * cos);
    let place = middle.to_vector() + turned * grown;
    let direction = (edge.orientation + yaw).rem_euclid(PI);
    let number = (direction / PI * DIRECTIONS as f64).round() as usize % DIRECTIONS;
    let channel = &field.log_ratios[number];
    let (sin, cos) = direction.sin_cos();
    let length = edge.size * grown;
    let count = ((length / LOOKED_UP) as usize).max(LEAST_LOOKED_UP);
    let share = (edge.size / USUAL_LENGTH).sqrt() as f32 / count as f32;
    let (width, height) = (channel.width() as i32, channel.height() as i32);
    let side = (2 * reach + 1) as usize;
    let step = (STEP / CELL) as i32;
    for index in 0..count {
        let along = ((index as f64 + 0.5) / count as f64 - 0.5) * length;
        let at = GroundPoint::new(place.x + along * cos, place.y + along * sin);
        let (x, y) = field.window.pixel_at(&at);
        let (x, y) = (x.floor() as i32, y.floor() as i32);
        for (row, sums) in log_sum.chunks_exact_mut(side).enumerate() {
            let y = y + (row as i32 - reach) * step;
            // Nothing is known beyond the field.
            if !(0..height).contains(&y) {
                continue;
            }
            let line = channel.row(y as usize);
            let first = x - reach * step;
            if first >= 0 && x + reach * step < width {
                let known = line[first as usize..].iter().step_by(step as usize);
                for (sum, value) in sums.iter_mut().zip(known) {
                    *sum += share * value;
                }
            } else {
                for (column, sum) in sums.iter_mut().enumerate() {
                    let x = first + column as i32 * step;
                    if (0..width).contains(&x) {
                        *sum += share * line[x as usize];
                    }
                }
            }
        }
    }
}
