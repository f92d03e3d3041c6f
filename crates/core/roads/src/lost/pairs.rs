//! Pairs of crossings, found by their distance and by the directions of their arms against the line between them.

use super::junctions::{ArmMask, Junction};
use crate::course::heading;

/// Least and greatest distance between the crossings of a pair, metres.
pub(super) const APART: (f64, f64) = (60.0, 420.0);
/// Most partners of a crossing, the nearest ones: bounds the memory in dense towns.
const PARTNERS: usize = 80;

/// Two crossings of the map.
#[derive(Clone, Copy, Debug)]
pub(super) struct CrossingPair {
    pub distance: f32,
    pub first: u32,
    pub second: u32,
    /// Arms of both against the direction from the first to the second, with the bins beside them.
    arms: [ArmMask; 2],
}

/// All pairs of a map by their distance.
#[derive(Clone, Debug, Default)]
pub(super) struct CrossingPairs {
    pairs: Vec<CrossingPair>,
}

impl CrossingPairs {
    /// Pairs of junctions, which lie in the order from south to north.
    pub fn new(junctions: &[Junction]) -> Self {
        let mut pairs = Vec::new();
        let mut near: Vec<(f64, usize)> = Vec::new();
        for (first, own) in junctions.iter().enumerate() {
            near.clear();
            for (second, other) in junctions.iter().enumerate().skip(first + 1) {
                // Merged places stand in nearly the order of their nodes.
                if other.place.north - own.place.north > APART.1 + 30.0 {
                    break;
                }
                let distance = own.place.distance(&other.place);
                if (APART.0..APART.1).contains(&distance) {
                    near.push((distance, second));
                }
            }
            near.sort_by(|a, b| a.0.total_cmp(&b.0));
            near.truncate(PARTNERS);
            for (distance, second) in &near {
                let other = &junctions[*second];
                let base = heading(own.place, other.place);
                pairs.push(CrossingPair {
                    distance: *distance as f32,
                    first: first as u32,
                    second: *second as u32,
                    arms: [own, other].map(|j| ArmMask::of(&j.arms, base).widened()),
                });
            }
        }
        pairs.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        Self { pairs }
    }

    /// Visits pairs whose distance lies within `distance` and whose arms hold most of `arms`, those of the first and
    /// second crossing of a pair that was seen, against the direction from first to second; told the pair, and whether
    /// the seen first is its second. Gives the number of pairs that were compared.
    pub fn visit(
        &self,
        distance: (f64, f64),
        arms: [ArmMask; 2],
        mut visit: impl FnMut(&CrossingPair, bool),
    ) -> usize {
        let at = |value: f64| {
            self.pairs
                .partition_point(|p| f64::from(p.distance) < value)
        };
        let all = arms.map(|mask| mask.0.count_ones());
        let is_like = |own: [ArmMask; 2], seen: [ArmMask; 2], all: [u32; 2]| {
            let common = [own[0].common(seen[0]), own[1].common(seen[1])];
            common[0] >= 2 && common[1] >= 2 && common[0] + common[1] + 1 >= all[0] + all[1]
        };
        // The other way round the line between them has turned by half a turn.
        let turned = [arms[1].turned(18), arms[0].turned(18)];
        let range = at(distance.0)..at(distance.1);
        for pair in &self.pairs[range.clone()] {
            if is_like(pair.arms, arms, all) {
                visit(pair, false);
            }
            if is_like(pair.arms, turned, [all[1], all[0]]) {
                visit(pair, true);
            }
        }
        range.len()
    }

    pub fn len(&self) -> usize {
        self.pairs.len()
    }

    /// Bytes that they take.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.pairs[..])
    }
}
