//! Many windows side by side in vector registers, with `Sight::look` of the tests as the twin that shows
//! one window after the other.
//!
//! The loops are plain and of a fixed length, so that the compiler makes vectors of whatever size
//! the function around them is compiled for: chosen at run time on x86-64, by the build on
//! WebAssembly. Every number is computed as the twin does, in the same order: results are equal to
//! the bit.
#![expect(
    unsafe_code,
    clippy::inline_always,
    clippy::needless_range_loop,
    reason = "functions for an instruction set that was looked for at run time, each compiled into the \
              function that enables it; table entries whose bounds are asserted once for all; loops over \
              several arrays of one fixed length"
)]

mod lanes;
mod looks;
mod places;
mod program;
mod windows;

pub(super) use program::CascadeProgram;
pub(super) use windows::RunningWindows;

use super::layout::{FeatureLayout, FeatureTables};

/// Defines a function that runs the loop of that name compiled for AVX2 where there is AVX2.
macro_rules! dispatched {
    ($(#[$meta:meta])* $name:ident, $fast:ident, ($($argument:ident: $type:ty),*)) => {
        #[cfg(target_arch = "x86_64")]
        #[target_feature(enable = "avx2,bmi1,bmi2")]
        fn $fast($($argument: $type),*) {
            lanes::$name($($argument),*);
        }

        $(#[$meta])*
        pub(super) fn $name($($argument: $type),*) {
            #[cfg(target_arch = "x86_64")]
            if is_x86_feature_detected!("avx2")
                && is_x86_feature_detected!("bmi1")
                && is_x86_feature_detected!("bmi2")
            {
                // SAFETY: the instructions were looked for.
                return unsafe { $fast($($argument),*) };
            }
            lanes::$name($($argument),*);
        }
    };
}

dispatched!(
    /// [`FeatureLayout::factor`] of as many windows side by side, from place `at` on, as `out` is long; NaN for
    /// flat ones.
    factors, factors_fast, (layout: &FeatureLayout, tables: &FeatureTables, at: usize, out: &mut [f32])
);
dispatched!(
    /// Sums of the votes of the first stage on windows side by side, from place `first` on, as many as
    /// there are `factors`; where all of some are NaN nothing is written.
    first_votes, first_votes_fast,
    (program: &CascadeProgram, tables: &FeatureTables, first: usize, factors: &[f32], votes: &mut [f64])
);
dispatched!(
    /// Pixels between two rows of them times 256, where the lower one weighs `weight` of 256.
    blend, blend_fast, (upper: &[u16], lower: &[u16], weight: u32, out: &mut [u8])
);
dispatched!(
    /// Shows one stage all windows, and writes down the sums of its votes.
    vote, vote_fast, (program: &CascadeProgram, stage: usize, tables: &FeatureTables, windows: &mut RunningWindows)
);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landmark::cascade::grid::RowGrid;
    use crate::landmark::cascade::{Cascade, CascadeFeature, NodeSplit, TrainedStage, TrainedTree};
    use pilotage_raster::raster::Raster;

    #[test]
    fn the_best_instructions_say_what_the_plainest_say() {
        let features: Vec<CascadeFeature> = (0..36)
            .map(|component| CascadeFeature::Hog {
                cell: [1, 0, 5, 6],
                component,
            })
            .collect();
        let tree = |i| TrainedTree::stump(i, NodeSplit::Threshold(0.03), -0.7, 0.3);
        let stage = TrainedStage {
            trees: (0..36).map(tree).collect(),
            threshold: 0.0,
        };
        let cascade = Cascade::from_parts(12, 12, features, &[stage]).unwrap();
        let picture = Raster::from_fn(70, 30, |x, y| ((x * 31 + y * 57 + x * y) % 256) as u8);
        for step in [1, 2] {
            let grid = RowGrid::new(70, step);
            let layout = FeatureLayout::new(&cascade.features, 12, 12, grid);
            let tables = layout.tables(&picture);
            let program = CascadeProgram::new(&cascade, &layout);
            let mut windows = RunningWindows::default();
            // Some side by side, some far apart.
            for number in [0, 1, 2, 5, 9, 10, 11, 12, 13, 20, 29] {
                windows.push(grid.place(0, 7) + number, 1.0, 0.0);
            }
            let mut plain = windows.clone();
            vote(&program, 0, &tables, &mut windows);
            lanes::vote(&program, 0, &tables, &mut plain);
            assert_eq!(windows.votes, plain.votes);
            assert!(windows.votes.iter().any(|v| *v != windows.votes[0]));
        }
    }
}
