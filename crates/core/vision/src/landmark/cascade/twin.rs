//! Windows shown one after the other: what [`super::rows`] is tested against.

use super::grid::RowGrid;
use super::layout::{FeatureLayout, FeatureTables};
use super::model::{Cascade, Tree};
use pilotage_raster::raster::Raster;

/// A picture seen through a cascade.
pub(super) struct CascadeView<'a> {
    cascade: &'a Cascade,
    layout: FeatureLayout,
    tables: FeatureTables,
}

/// Answer of a cascade on a window.
pub(super) struct WindowAnswer {
    /// Stages passed.
    pub passed: usize,
    /// Whether the window was so flat that no stage was asked.
    pub flat: bool,
    /// Votes of the last stage met.
    pub votes: f64,
    /// Sum over the stages met of votes less threshold; minus infinity where none was.
    pub margin: f64,
}

impl<'a> CascadeView<'a> {
    pub fn new(cascade: &'a Cascade, picture: &Raster<u8>) -> Self {
        let grid = RowGrid::new(picture.width(), 1);
        let layout = FeatureLayout::new(&cascade.features, cascade.width, cascade.height, grid);
        Self {
            cascade,
            tables: layout.tables(picture),
            layout,
        }
    }

    /// Shows the window whose upper left pixel is (x, y).
    pub fn look(&self, x: usize, y: usize) -> WindowAnswer {
        let at = y * self.layout.grid.stride + x;
        let mut seen = WindowAnswer {
            passed: 0,
            flat: false,
            votes: 0.0,
            margin: 0.0,
        };
        let Some(factor) = self.layout.factor(&self.tables, at) else {
            seen.flat = true;
            seen.margin = f64::NEG_INFINITY;
            return seen;
        };
        for stage in &self.cascade.stages {
            let trees = self.cascade.trees[stage.trees.clone()].iter();
            seen.votes = trees.fold(0.0, |sum, tree| sum + self.vote(tree, at, factor));
            let margin = seen.votes - f64::from(stage.threshold);
            seen.margin += margin;
            if margin < 0.0 {
                break;
            }
            seen.passed += 1;
        }
        seen
    }

    fn vote(&self, tree: &Tree, at: usize, factor: f32) -> f64 {
        let mut next = 0;
        loop {
            let index = tree.nodes.start + next as usize;
            let node = &self.cascade.nodes[index];
            let feature = node.feature as usize;
            let left = if let Some(subset) = self.cascade.subsets.get(index) {
                let code = self.layout.code(&self.tables, feature, at);
                subset[code >> 5] >> (code & 31) & 1 == 1
            } else {
                self.layout.value(&self.tables, feature, at, factor) < node.threshold
            };
            next = if left { node.left } else { node.right };
            if next <= 0 {
                let leaf = tree.first_leaf + next.unsigned_abs() as usize;
                return f64::from(self.cascade.leaves[leaf]);
            }
        }
    }
}
