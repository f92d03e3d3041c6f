//! The loops.

use std::ops::Range;

use super::looks::NodeDecision;
use super::places::{LANES, Lanes, Scattered, SideBySide, WindowPlaces};
use super::program::{Branch, Branches, CascadeProgram};
use super::windows::RunningWindows;
use crate::landmark::cascade::layout::{FeatureLayout, FeatureTables};

/// Windows of a row of [`LANES`] that make it worth while to work on all of it.
const WORTH: usize = 3;

#[inline(always)]
pub(super) fn factors(layout: &FeatureLayout, tables: &FeatureTables, at: usize, out: &mut [f32]) {
    let length = out.len();
    let (sum, squares) = (&tables.integral.sum, &tables.integral.squares);
    let [a, b, c, d] = layout.norm.map(|corner| &sum[at + corner..][..length]);
    let [e, f, g, h] = layout.norm.map(|corner| &squares[at + corner..][..length]);
    let area = layout.norm_area;
    for i in 0..length {
        let sum = f64::from(
            a[i].wrapping_sub(b[i])
                .wrapping_sub(c[i])
                .wrapping_add(d[i]),
        );
        let squares = e[i]
            .wrapping_sub(f[i])
            .wrapping_sub(g[i])
            .wrapping_add(h[i]);
        let spread = area * f64::from(squares.cast_unsigned()) - sum * sum;
        let factor = (1.0 / spread.sqrt()) as f32;
        let usable = spread > 0.0 && area * f64::from(factor) < 0.1;
        out[i] = if usable { factor } else { f32::NAN };
    }
}

#[inline(always)]
pub(super) fn vote(
    program: &CascadeProgram,
    stage: usize,
    tables: &FeatureTables,
    windows: &mut RunningWindows,
) {
    match &program.branches {
        Branches::Haar(branches) => vote_with(program, branches, stage, tables, windows),
        Branches::Lbp(branches) => vote_with(program, branches, stage, tables, windows),
        Branches::Hog(branches) => vote_with(program, branches, stage, tables, windows),
    }
}

#[inline(always)]
pub(super) fn first_votes(
    program: &CascadeProgram,
    tables: &FeatureTables,
    first: usize,
    factors: &[f32],
    votes: &mut [f64],
) {
    match &program.branches {
        Branches::Haar(all) => first_votes_with(program, all, tables, first, factors, votes),
        Branches::Lbp(all) => first_votes_with(program, all, tables, first, factors, votes),
        Branches::Hog(all) => first_votes_with(program, all, tables, first, factors, votes),
    }
}

#[inline(always)]
fn first_votes_with<L: NodeDecision>(
    program: &CascadeProgram,
    branches: &[Branch<L>],
    tables: &FeatureTables,
    first: usize,
    factors: &[f32],
    votes: &mut [f64],
) {
    assert!(first + factors.len() + program.reach + LANES <= program.shortest(tables));
    assert!(factors.len() == votes.len());
    let job = StageCall {
        program,
        branches,
        stage: program.stages[0].clone(),
        tables,
    };
    let mut reached = vec![[0; LANES]; program.largest];
    let all = factors.chunks(LANES).zip(votes.chunks_mut(LANES));
    for (number, (from, to)) in all.enumerate() {
        if from.iter().all(|factor| factor.is_nan()) {
            continue;
        }
        let mut factors = [1.0; LANES];
        let mut sums = [0.0; LANES];
        factors[..from.len()].copy_from_slice(from);
        let places = SideBySide(first + number * LANES);
        job.sum(&places, &factors, &mut sums, &mut reached);
        to.copy_from_slice(&sums[..to.len()]);
    }
}

#[inline(always)]
pub(super) fn blend(upper: &[u16], lower: &[u16], weight: u32, out: &mut [u8]) {
    for ((out, &a), &b) in out.iter_mut().zip(upper).zip(lower) {
        let value = (256 - weight) * u32::from(a) + weight * u32::from(b);
        *out = ((value + (1 << 15)) >> 16) as u8;
    }
}

#[inline(always)]
fn vote_with<L: NodeDecision>(
    program: &CascadeProgram,
    branches: &[Branch<L>],
    stage: usize,
    tables: &FeatureTables,
    windows: &mut RunningWindows,
) {
    let count = windows.at.len();
    let Some(&last) = windows.at.iter().max() else {
        return;
    };
    assert!(last + program.reach + LANES <= program.shortest(tables));
    assert!(windows.factor.len() == count && windows.votes.len() == count);
    let job = StageCall {
        program,
        branches,
        stage: program.stages[stage].clone(),
        tables,
    };
    let mut reached = vec![[0; LANES]; program.largest];
    let mut done = 0;
    while done < count {
        let at = &windows.at[done..];
        let near = at
            .iter()
            .take(LANES)
            .filter(|a| **a - at[0] < LANES)
            .count();
        let mut factors = [1.0; LANES];
        let mut sums = [0.0; LANES];
        if near >= WORTH.min(at.len()) {
            let lane = |i: usize| at[i] - at[0];
            for i in 0..near {
                factors[lane(i)] = windows.factor[done + i];
            }
            job.sum(&SideBySide(at[0]), &factors, &mut sums, &mut reached);
            for i in 0..near {
                windows.votes[done + i] = sums[lane(i)];
            }
            done += near;
        } else {
            let some = at.len().min(LANES);
            let mut places = [at[0]; LANES];
            places[..some].copy_from_slice(&at[..some]);
            factors[..some].copy_from_slice(&windows.factor[done..][..some]);
            job.sum(&Scattered(places), &factors, &mut sums, &mut reached);
            windows.votes[done..][..some].copy_from_slice(&sums[..some]);
            done += some;
        }
    }
}

/// A stage and what it looks at.
struct StageCall<'a, L> {
    program: &'a CascadeProgram,
    branches: &'a [Branch<L>],
    stage: Range<usize>,
    tables: &'a FeatureTables,
}

impl<L: NodeDecision> StageCall<'_, L> {
    /// Adds the votes of all trees, one after the other.
    #[inline(always)]
    fn sum(
        &self,
        places: &impl WindowPlaces,
        factors: &Lanes<f32>,
        sums: &mut Lanes<f64>,
        reached: &mut [Lanes<u32>],
    ) {
        for tree in &self.program.trees[self.stage.clone()] {
            let leaves = &self.program.leaves[tree.first_leaf..];
            let leaf = |next: i32| leaves[next.unsigned_abs() as usize];
            let branches = &self.branches[tree.nodes.clone()];
            if let [stump] = branches {
                let (left, right) = (f64::from(leaf(stump.left)), f64::from(leaf(stump.right)));
                let goes_left = stump.look.left(self.tables, places, factors);
                for i in 0..LANES {
                    sums[i] += if goes_left[i] == 0 { right } else { left };
                }
                continue;
            }
            // A window reaches exactly one leaf: the bits of all others stay away.
            let mut votes = [0; LANES];
            reached[0] = [!0; LANES];
            reached[1..].fill([0; LANES]);
            for (n, branch) in branches.iter().enumerate() {
                let goes_left = branch.look.left(self.tables, places, factors);
                let here = reached[n];
                for (next, flip) in [(branch.left, 0), (branch.right, !0)] {
                    let out = if next > 0 {
                        &mut reached[next as usize]
                    } else {
                        &mut votes
                    };
                    let bits = if next > 0 { !0 } else { leaf(next).to_bits() };
                    for i in 0..LANES {
                        out[i] |= here[i] & (goes_left[i] ^ flip) & bits;
                    }
                }
            }
            for i in 0..LANES {
                sums[i] += f64::from(f32::from_bits(votes[i]));
            }
        }
    }
}
