//! Decisions of nodes, for many windows at once.

use super::places::{LANES, Lanes, WindowPlaces};
use crate::landmark::cascade::layout::{CornerSum, FeatureTables, LEAST_EDGE};

/// All bits or none.
#[inline(always)]
fn mask(yes: bool) -> u32 {
    if yes { !0 } else { 0 }
}

/// Decision of a node.
pub(super) trait NodeDecision {
    /// For each window, all bits if it goes left, and none otherwise.
    fn left(
        &self,
        tables: &FeatureTables,
        places: &impl WindowPlaces,
        factors: &Lanes<f32>,
    ) -> Lanes<u32>;
}

/// Weighted sums of rectangles below a threshold.
#[derive(Clone, Debug)]
pub(super) struct Haar {
    corners: [CornerSum; 3],
    weights: [f32; 3],
    three: bool,
    tilted: bool,
    threshold: f32,
}

impl Haar {
    pub fn new(areas: &[(CornerSum, f32); 3], tilted: bool, threshold: f32) -> Self {
        Self {
            corners: areas.map(|a| a.0),
            weights: areas.map(|a| a.1),
            three: areas[2].1 != 0.0,
            tilted,
            threshold,
        }
    }

    #[inline(always)]
    fn table<'a>(&self, tables: &'a FeatureTables) -> &'a [i32] {
        if self.tilted {
            &tables.integral.tilted
        } else {
            &tables.integral.sum
        }
    }
}

impl NodeDecision for Haar {
    #[inline(always)]
    fn left(
        &self,
        tables: &FeatureTables,
        places: &impl WindowPlaces,
        factors: &Lanes<f32>,
    ) -> Lanes<u32> {
        let table = self.table(tables);
        let first = places.sums(table, &self.corners[0]);
        let second = places.sums(table, &self.corners[1]);
        let mut values = [0.0; LANES];
        for i in 0..LANES {
            values[i] = self.weights[0] * first[i] as f32 + self.weights[1] * second[i] as f32;
        }
        if self.three {
            let third = places.sums(table, &self.corners[2]);
            for i in 0..LANES {
                values[i] += self.weights[2] * third[i] as f32;
            }
        }
        let mut left = [0; LANES];
        for i in 0..LANES {
            left[i] = mask(values[i] * factors[i] < self.threshold);
        }
        left
    }
}

/// Codes in a set.
#[derive(Clone, Debug)]
pub(super) struct Lbp {
    lattice: [usize; 16],
    codes: [u32; 8],
}

impl Lbp {
    pub fn new(lattice: &[usize; 16], codes: [u32; 8]) -> Self {
        Self {
            lattice: *lattice,
            codes,
        }
    }
}

impl NodeDecision for Lbp {
    #[inline(always)]
    fn left(
        &self,
        tables: &FeatureTables,
        places: &impl WindowPlaces,
        _: &Lanes<f32>,
    ) -> Lanes<u32> {
        let table = &tables.integral.sum;
        let entries = places.entries(table, &self.lattice);
        let mut sums = [[0_i32; LANES]; 9];
        for row in 0..3 {
            for column in 0..3 {
                let at = 4 * row + column;
                for i in 0..LANES {
                    let left = entries[at][i].wrapping_sub(entries[at + 4][i]);
                    let right = entries[at + 1][i].wrapping_sub(entries[at + 5][i]);
                    sums[3 * row + column][i] = left.wrapping_sub(right);
                }
            }
        }
        let mut codes = [0_u32; LANES];
        // Clockwise from the upper left one, the first in the highest bit.
        for block in [0, 1, 2, 5, 8, 7, 6, 3] {
            for i in 0..LANES {
                codes[i] = codes[i] << 1 | u32::from(sums[block][i] >= sums[4][i]);
            }
        }
        let mut left = [0; LANES];
        for i in 0..LANES {
            let bit = |n: u32| mask(codes[i] >> n & 1 == 1);
            let [a, b, c] = [bit(7), bit(6), bit(5)];
            let either = |m: u32, one: u32, other: u32| one & m | other & !m;
            let w = &self.codes;
            let low = either(b, either(c, w[3], w[2]), either(c, w[1], w[0]));
            let high = either(b, either(c, w[7], w[6]), either(c, w[5], w[4]));
            left[i] = mask(either(a, high, low) >> (codes[i] & 31) & 1 == 1);
        }
        left
    }
}

/// Shares of edges below a threshold.
#[derive(Clone, Debug)]
pub(super) struct Hog {
    cell: CornerSum,
    block: CornerSum,
    direction: usize,
    unit: f32,
    threshold: f32,
}

impl Hog {
    pub fn new(
        cell: &CornerSum,
        block: &CornerSum,
        direction: usize,
        unit: f32,
        threshold: f32,
    ) -> Self {
        Self {
            cell: *cell,
            block: *block,
            direction,
            unit,
            threshold,
        }
    }
}

impl NodeDecision for Hog {
    #[inline(always)]
    fn left(
        &self,
        tables: &FeatureTables,
        places: &impl WindowPlaces,
        _: &Lanes<f32>,
    ) -> Lanes<u32> {
        let own = places.sums(&tables.histograms.directions[self.direction], &self.cell);
        let all = places.sums(&tables.histograms.all, &self.block);
        let mut left = [0; LANES];
        for i in 0..LANES {
            let own = own[i] as f32 * self.unit;
            let share = own / (all[i] as f32 * self.unit + LEAST_EDGE);
            left[i] = mask((if own > LEAST_EDGE { share } else { 0.0 }) < self.threshold);
        }
        left
    }
}
