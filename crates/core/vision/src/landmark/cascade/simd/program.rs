//! A cascade laid out for tables, in the order in which it is read.

use std::ops::Range;

use super::looks::{Haar, Hog, Lbp};
use crate::landmark::cascade::grid::RowGrid;
use crate::landmark::cascade::layout::{FeatureLayout, FeatureTables, LaidOutFeature};
use crate::landmark::cascade::model::{Cascade, CascadeKind, any_tilted};

/// A node of a tree: how it decides, and where that leads (as in [`Cascade`]).
#[derive(Clone, Debug)]
pub(super) struct Branch<L> {
    pub look: L,
    pub left: i32,
    pub right: i32,
}

/// A tree: its nodes, and where its leaves begin.
#[derive(Clone, Debug)]
pub(super) struct Votes {
    pub nodes: Range<usize>,
    pub first_leaf: usize,
}

/// Nodes of one kind.
#[derive(Clone, Debug)]
pub(super) enum Branches {
    Haar(Vec<Branch<Haar>>),
    Lbp(Vec<Branch<Lbp>>),
    Hog(Vec<Branch<Hog>>),
}

/// A cascade laid out for tables.
#[derive(Clone, Debug)]
pub(in super::super) struct CascadeProgram {
    pub(super) stages: Vec<Range<usize>>,
    pub(super) trees: Vec<Votes>,
    pub(super) branches: Branches,
    pub(super) leaves: Vec<f32>,
    /// Nodes of the largest tree.
    pub(super) largest: usize,
    /// Furthest place from a window's own that is asked for.
    pub(super) reach: usize,
    /// Whether any feature is turned.
    with_tilted: bool,
}

/// Branches, one for each node whose feature is of the kind that `look` takes: all of them.
fn branches<L>(
    cascade: &Cascade,
    grid: RowGrid,
    reach: usize,
    look: impl Fn(usize, &LaidOutFeature) -> Option<L>,
) -> Vec<Branch<L>> {
    let mut branches = Vec::with_capacity(cascade.nodes.len());
    for (i, node) in cascade.nodes.iter().enumerate() {
        let laid = LaidOutFeature::new(&cascade.features[node.feature as usize], grid);
        assert!(laid.reach() <= reach, "the feature leaves the window");
        branches.extend(look(i, &laid).map(|look| Branch {
            look,
            left: node.left,
            right: node.right,
        }));
    }
    assert_eq!(branches.len(), cascade.nodes.len(), "features of one kind");
    branches
}

impl CascadeProgram {
    /// For tables laid out as those of `layout`.
    pub fn new(cascade: &Cascade, layout: &FeatureLayout) -> Self {
        let grid = layout.grid;
        // No feature leaves the window; of even and odd columns, either may lie further in memory.
        let corner = |back| grid.place(cascade.width - back, cascade.height);
        let reach = corner(0).max(corner(1));
        let threshold = |node: usize| cascade.nodes[node].threshold;
        let branches = match layout.kind {
            CascadeKind::Haar => {
                Branches::Haar(branches(cascade, grid, reach, |node, laid| match laid {
                    LaidOutFeature::Haar { areas, tilted } => {
                        Some(Haar::new(areas, *tilted, threshold(node)))
                    }
                    _ => None,
                }))
            }
            CascadeKind::Lbp => {
                Branches::Lbp(branches(cascade, grid, reach, |node, laid| match laid {
                    LaidOutFeature::Lbp(lattice) => Some(Lbp::new(lattice, cascade.subsets[node])),
                    _ => None,
                }))
            }
            CascadeKind::Hog => {
                Branches::Hog(branches(cascade, grid, reach, |node, laid| match laid {
                    LaidOutFeature::Hog {
                        cell,
                        block,
                        direction,
                    } => Some(Hog::new(
                        cell,
                        block,
                        *direction,
                        layout.unit,
                        threshold(node),
                    )),
                    _ => None,
                }))
            }
        };
        let trees = cascade.trees.iter().map(|tree| Votes {
            nodes: tree.nodes.clone(),
            first_leaf: tree.first_leaf,
        });
        let sizes = cascade.trees.iter().map(|tree| tree.nodes.len());
        Self {
            stages: cascade.stages.iter().map(|s| s.trees.clone()).collect(),
            trees: trees.collect(),
            branches,
            leaves: cascade.leaves.clone(),
            largest: sizes.max().unwrap_or(0),
            reach,
            with_tilted: any_tilted(&cascade.features),
        }
    }

    /// Length of the shortest table that is read.
    pub(super) fn shortest(&self, tables: &FeatureTables) -> usize {
        let (integral, histograms) = (&tables.integral, &tables.histograms);
        match self.branches {
            Branches::Haar(_) if self.with_tilted => integral.sum.len().min(integral.tilted.len()),
            Branches::Haar(_) | Branches::Lbp(_) => integral.sum.len(),
            Branches::Hog(_) => {
                let directions = histograms.directions.iter().map(Vec::len);
                directions.fold(histograms.all.len(), usize::min)
            }
        }
    }
}
