//! How a node decides, for many windows at once.

use super::lanes::{LANES, Lanes, Places};
use crate::landmark::cascade::layout::{Corners, LEAST_EDGE, Tables};

/// All bits or none.
#[inline(always)]
fn mask(yes: bool) -> u32 {
    if yes { !0 } else { 0 }
}

/// How a node decides.
pub(super) trait Look {
    /// For each window, all bits if it goes left, and none otherwise.
    fn left(&self, tables: &Tables, places: &impl Places, factors: &Lanes<f32>) -> Lanes<u32>;
}

/// Weighted sums of rectangles below a threshold.
#[derive(Clone, Debug)]
pub(super) struct Haar {
    corners: [Corners; 3],
    weights: [f32; 3],
    three: bool,
    tilted: bool,
    threshold: f32,
}

impl Haar {
    pub fn new(areas: &[(Corners, f32); 3], tilted: bool, threshold: f32) -> Self {
        Self {
            corners: areas.map(|a| a.0),
            weights: areas.map(|a| a.1),
            three: areas[2].1 != 0.0,
            tilted,
            threshold,
        }
    }

    #[inline(always)]
    fn table<'a>(&self, tables: &'a Tables) -> &'a [i32] {
        if self.tilted {
            &tables.integral.tilted
        } else {
            &tables.integral.sum
        }
    }
}

impl Look for Haar {
    #[inline(always)]
    fn left(&self, tables: &Tables, places: &impl Places, factors: &Lanes<f32>) -> Lanes<u32> {
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

impl Look for Lbp {
    #[inline(always)]
    fn left(&self, tables: &Tables, places: &impl Places, _: &Lanes<f32>) -> Lanes<u32> {
        let table = &tables.integral.sum;
        let corners = |i: usize| {
            let at = &self.lattice;
            [at[i], at[i + 1], at[i + 4], at[i + 5]]
        };
        let middle = places.sums(table, &corners(5));
        let mut codes = [0_u32; LANES];
        // Clockwise from the upper left one, the first in the highest bit.
        for block in [0, 1, 2, 6, 10, 9, 8, 4] {
            let sums = places.sums(table, &corners(block));
            for i in 0..LANES {
                codes[i] = codes[i] << 1 | u32::from(sums[i] >= middle[i]);
            }
        }
        let mut left = [0; LANES];
        for i in 0..LANES {
            let word = self.codes[(codes[i] >> 5 & 7) as usize];
            left[i] = mask(word >> (codes[i] & 31) & 1 == 1);
        }
        left
    }
}

/// Shares of edges below a threshold.
#[derive(Clone, Debug)]
pub(super) struct Hog {
    cell: Corners,
    block: Corners,
    direction: usize,
    unit: f32,
    threshold: f32,
}

impl Hog {
    pub fn new(
        cell: &Corners,
        block: &Corners,
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

impl Look for Hog {
    #[inline(always)]
    fn left(&self, tables: &Tables, places: &impl Places, _: &Lanes<f32>) -> Lanes<u32> {
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
