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
/// Most trials that are kept, rather than made once more: 64 MB.
const KEPT: usize = 1 << 24;
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
    place_by_edges_telling(seen, prior, field, &mut |_| ())
}

/// As [`place_by_edges`]; `tell` is told the share that is done, many times.
pub(super) fn place_by_edges_telling(
    seen: &[GenericLandmark],
    prior: &EdgePrior,
    field: &EdgeField,
    tell: &mut dyn FnMut(f64),
) -> Option<EdgePlace> {
    place_keeping(seen, prior, field, (KEPT, tell))
}

/// Number of places by headings and scales that are tried, and of comparisons with the table that they take.
pub(super) fn look_ups(seen: &[GenericLandmark], prior: &EdgePrior) -> (f64, f64) {
    let Trials { reach, turns, .. } = Trials::of(prior);
    let side = 2.0 * reach as f64 + 1.0;
    let trials = side * side * (2.0 * turns as f64 + 1.0) * f64::from(2 * SCALES + 1);
    let of_each: f64 = seen.iter().map(|edge| parts_of(edge.size) as f64).sum();
    (trials, trials * of_each)
}

/// Places, headings and scales that a belief allows.
#[derive(Clone, Copy)]
struct Trials<'p> {
    prior: &'p EdgePrior,
    /// Steps to the farthest place, and to the farthest heading.
    reach: i64,
    turns: i64,
}

impl<'p> Trials<'p> {
    fn of(prior: &'p EdgePrior) -> Self {
        Self {
            prior,
            reach: (FARTHEST * prior.deviation / STEP).ceil() as i64,
            turns: (prior.turn / TURN).ceil() as i64,
        }
    }

    fn side(&self) -> usize {
        (2 * self.reach + 1) as usize
    }

    /// Numbers of headings and scales, those of a heading after each other.
    fn poses(&self) -> usize {
        (2 * self.turns + 1) as usize * (2 * SCALES + 1) as usize
    }

    fn scale(pose: usize) -> i32 {
        pose as i32 % (2 * SCALES + 1) - SCALES
    }

    /// Sums of what the field says of all edges by a heading and a scale, for every place.
    fn sums(&self, pose: usize, seen: &[GenericLandmark], field: &EdgeField, sums: &mut [f32]) {
        let turn = (pose / (2 * SCALES + 1) as usize) as i64 - self.turns;
        let yaw = turn as f64 * self.prior.turn / self.turns.max(1) as f64;
        let grown = (deviations(Self::scale(pose)) * self.prior.log_height).exp();
        sums.fill(0.0);
        for edge in seen {
            let reach = self.reach as i32;
            add(sums, edge, self.prior.middle, (yaw, grown), field, reach);
        }
    }

    fn shift(&self, place: usize) -> Vector2<f64> {
        let (row, column) = (place / self.side(), place % self.side());
        let steps = |index: usize| (index as i64 - self.reach) as f64;
        Vector2::new(-steps(row), steps(column)) * STEP
    }

    /// Logarithm of the belief in a place and scale.
    fn believed(&self, scale: i32, place: usize) -> f64 {
        let place = self.shift(place).norm_squared() / self.prior.deviation.powi(2);
        -0.5 * (place + deviations(scale).powi(2))
    }
}

/// The place, with at most so many trials kept from the first time that all are made to the second.
fn place_keeping(
    seen: &[GenericLandmark],
    prior: &EdgePrior,
    field: &EdgeField,
    (most_kept, tell): (usize, &mut dyn FnMut(f64)),
) -> Option<EdgePlace> {
    if seen.is_empty() {
        return None;
    }
    let trials = Trials::of(prior);
    let (places, poses) = (trials.side().pow(2), trials.poses());
    let mut kept: Vec<f32> = Vec::new();
    let is_kept = places.saturating_mul(poses) <= most_kept;
    let rounds = if is_kept { 1.0 } else { 2.0 };
    let mut sums = vec![0.0_f32; places];
    let (mut likeliest, mut top) = (0, f64::NEG_INFINITY);
    for pose in 0..poses {
        trials.sums(pose, seen, field, &mut sums);
        let scale = Trials::scale(pose);
        for (place, sum) in sums.iter().enumerate() {
            let log = f64::from(*sum) / TEMPERATURE + trials.believed(scale, place);
            if log > top {
                (likeliest, top) = (place, log);
            }
        }
        if is_kept {
            kept.extend_from_slice(&sums);
        }
        tell((pose + 1) as f64 / (rounds * poses as f64));
    }
    let likeliest = trials.shift(likeliest);
    let (mut all, mut here, mut chance) = (0.0, 0.0, 0.0);
    let (mut first, mut second) = (Vector2::zeros(), Matrix2::zeros());
    for pose in 0..poses {
        if is_kept {
            sums.copy_from_slice(&kept[pose * places..][..places]);
        } else {
            trials.sums(pose, seen, field, &mut sums);
            tell(0.5 + 0.5 * (pose + 1) as f64 / poses as f64);
        }
        let scale = Trials::scale(pose);
        for (place, sum) in sums.iter().enumerate() {
            let (shift, before) = (trials.shift(place), trials.believed(scale, place));
            let weight = (f64::from(*sum) / TEMPERATURE + before - top).exp();
            all += weight;
            chance += before.exp();
            if (shift - likeliest).norm() <= SAME {
                here += weight;
                first += shift * weight;
                second += shift * shift.transpose() * weight;
            }
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

/// Number of places along an edge of that length that are looked up.
fn parts_of(length: f64) -> usize {
    ((length / LOOKED_UP) as usize).max(LEAST_LOOKED_UP)
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
    let count = parts_of(length);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::EDGE;
    use crate::{GenericClass, ReferenceTable};

    #[test]
    fn a_place_is_the_same_to_the_bit_whether_its_trials_are_kept_or_made_twice() {
        let edge = |number: i32| {
            let value = f64::from(number);
            GenericLandmark {
                place: GroundPoint::new(60.0 * (2.3 * value).sin(), 60.0 * (1.7 * value).cos()),
                class: GenericClass::Other(0),
                size: 6.0 + (5.1 * value).sin().abs() * 20.0,
                orientation: (0.9 * value).rem_euclid(PI),
                confidence: 1.0,
                stability: 1.0,
            }
        };
        let edges: Vec<GenericLandmark> = (0..60).map(edge).collect();
        let table = ReferenceTable::new(edges.clone(), vec![EDGE.to_owned()]);
        let field = EdgeField::around(GroundPoint::default(), 120.0, &table);
        let prior = EdgePrior {
            middle: GroundPoint::new(5.0, -3.0),
            deviation: 8.0,
            turn: 0.1,
            log_height: 0.03,
            map_deviation: 1.0,
        };
        let (mut told, mut last) = (0, 0.0);
        let [kept, twice] = [KEPT, 0].map(|most| {
            place_keeping(
                &edges,
                &prior,
                &field,
                (most, &mut |share| {
                    assert!(share > 0.0 && share <= 1.0);
                    (told, last) = (told + 1, share);
                }),
            )
        });
        assert!(kept.is_some() && kept == twice);
        let poses = Trials::of(&prior).poses();
        assert_eq!((told, last), (3 * poses, 1.0));
    }
}
