//! Crossings as an aircraft sees them: what lies within a few metres is one.

use std::f64::consts::TAU;

use nalgebra::Vector2;
use pilotage_base::frames::{GroundPoint, wrap_pi};

use super::tiles::PieceTiles;
use crate::course::heading;
use crate::map::RoadMap;

/// Distance within which nodes of a map are one crossing, metres: the two carriageways of a street.
const MERGED: f64 = 14.0;
/// Distance from the middle of a crossing at which the direction of its arms is taken, metres.
const RADIUS: f64 = 15.0;
/// Least angle between two arms, radians.
const APART: f64 = 0.4;

/// Bins of the directions of arms.
const ARM_BINS: u32 = 36;

/// Crossing of the map with what its arms look like from the air.
#[derive(Clone, Debug)]
pub(super) struct Junction {
    pub place: GroundPoint,
    /// Outward directions, radians clockwise from north.
    pub arms: Vec<f64>,
}

/// Set of directions in bins of ten degrees.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct ArmMask(pub u64);

impl ArmMask {
    /// Directions against `base`, each with its bin alone.
    pub fn of(arms: &[f64], base: f64) -> Self {
        let bit = |arm: &f64| {
            let share = (arm - base).rem_euclid(TAU) / TAU * f64::from(ARM_BINS);
            1_u64 << (share as u32 % ARM_BINS)
        };
        Self(arms.iter().map(bit).fold(0, |mask, bit| mask | bit))
    }

    /// The same with the bins beside them.
    #[must_use]
    pub fn widened(self) -> Self {
        Self(self.0 | self.turned(1).0 | self.turned(ARM_BINS - 1).0)
    }

    /// All directions turned on by so many bins.
    #[must_use]
    pub fn turned(self, bins: u32) -> Self {
        let bins = bins % ARM_BINS;
        let all = (1_u64 << ARM_BINS) - 1;
        Self((self.0 << bins | self.0 >> (ARM_BINS - bins)) & all)
    }

    /// Number of directions that both have.
    pub fn common(self, other: Self) -> u32 {
        (self.0 & other.0).count_ones()
    }
}

/// The crossings of a map, those near each other as one.
pub(super) fn junctions(map: &RoadMap, tiles: &PieceTiles) -> Vec<Junction> {
    let mut places: Vec<GroundPoint> = map.crossings().iter().map(|c| c.place).collect();
    places.sort_by(|a, b| a.north.total_cmp(&b.north).then(a.east.total_cmp(&b.east)));
    let mut is_taken = vec![false; places.len()];
    let mut found = Vec::new();
    for first in 0..places.len() {
        if is_taken[first] {
            continue;
        }
        let (mut sum, mut count) = (Vector2::zeros(), 0.0);
        for (place, is_taken) in places.iter().zip(&mut is_taken).skip(first) {
            if place.north - places[first].north > MERGED {
                break;
            }
            if !*is_taken && place.distance(&places[first]) <= MERGED {
                *is_taken = true;
                sum += place.to_vector();
                count += 1.0;
            }
        }
        let place = GroundPoint::from(sum / count);
        let arms = arms(place, tiles);
        if arms.len() > 2 {
            found.push(Junction { place, arms });
        }
    }
    found
}

/// Outward directions of the roads that cut a circle around a place.
fn arms(place: GroundPoint, tiles: &PieceTiles) -> Vec<f64> {
    let mut arms: Vec<f64> = Vec::new();
    tiles.visit_pieces(place, RADIUS, |[from, to]| {
        let (a, b) = (
            from.to_vector() - place.to_vector(),
            to.to_vector() - place.to_vector(),
        );
        let (inner, outer) = if a.norm() < b.norm() { (a, b) } else { (b, a) };
        if inner.norm() > RADIUS || outer.norm() <= RADIUS {
            return;
        }
        let arm = heading(inner.into(), outer.into());
        if arms.iter().all(|known| wrap_pi(arm - known).abs() > APART) {
            arms.push(arm);
        }
    });
    arms.sort_by(f64::total_cmp);
    arms
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arms_are_compared_in_bins_with_their_neighbours() {
        let own = ArmMask::of(&[0.1, 1.7, 3.2], 0.0);
        let turned = ArmMask::of(&[0.1 + 2.0, 1.7 + 2.0, 3.2 + 2.0], 2.0);
        assert!(own.widened().common(turned) == 3);
        let other = ArmMask::of(&[0.8, 2.4, 4.0], 0.0);
        assert_eq!(own.widened().common(other), 0);
        assert_eq!(own.turned(36), own);
        assert_eq!(own.turned(20).turned(16), own);
    }
}
