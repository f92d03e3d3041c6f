//! A cascade in memory.

use std::ops::Range;

use serde::{Deserialize, Serialize};

/// A rectangle of the window: left, top, width, height, pixels.
pub type Area = [i32; 4];

/// Feature that a cascade looks at.
#[derive(Clone, Debug, PartialEq)]
pub enum CascadeFeature {
    /// Weighted sums of rectangles (Viola and Jones 2001, tilted ones by Lienhart 2002).
    Haar(HaarFeature),
    /// Nine blocks, each compared with the middle one; the first of them: left, top, width, height.
    Lbp(Area),
    /// Share of one direction of the edges in one of four cells of a block (Dalal and Triggs 2005, as
    /// the cascades of OpenCV 2.4 and of MATLAB's `trainCascadeObjectDetector` use it).
    Hog {
        /// The upper left cell; the other three, of the same size, lie right of it, below it, and both.
        cell: Area,
        /// Nine times the cell (upper left, upper right, lower left, lower right) plus the direction:
        /// of nine, 20° wide; the first holds gradients of 10° to 30° from x towards y, or opposite.
        component: u8,
    },
}

/// Numbers that a HOG block has: four cells of nine directions.
pub(super) const COMPONENTS: u8 = 36;

/// Kind of a cascade's features; all of them are of one kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum CascadeKind {
    /// [`CascadeFeature::Haar`].
    Haar,
    /// [`CascadeFeature::Lbp`].
    Lbp,
    /// [`CascadeFeature::Hog`].
    Hog,
}

impl CascadeFeature {
    /// Its kind.
    pub fn kind(&self) -> CascadeKind {
        match self {
            CascadeFeature::Haar(_) => CascadeKind::Haar,
            CascadeFeature::Lbp(_) => CascadeKind::Lbp,
            CascadeFeature::Hog { .. } => CascadeKind::Hog,
        }
    }
}

/// Sums of pixels in up to three rectangles, each with a weight.
#[derive(Clone, Debug, PartialEq)]
pub struct HaarFeature {
    /// The rectangles; a weight of zero stands for none.
    pub areas: [(Area, f32); 3],
    /// Whether the rectangles are turned by 45°.
    pub tilted: bool,
}

/// A node of a tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TreeNode {
    /// Index of the feature.
    pub feature: u32,
    /// Next node of the tree if positive, otherwise the negative index of a leaf.
    pub left: i32,
    /// See `left`.
    pub right: i32,
    /// Threshold of a Haar or HOG feature; less goes left.
    pub threshold: f32,
}

/// Nodes and leaves of a tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Tree {
    pub nodes: Range<usize>,
    pub first_leaf: usize,
}

/// Stage of a cascade.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// Its trees.
    pub(super) trees: Range<usize>,
    /// Least sum of votes of a window that passes.
    pub threshold: f32,
}

impl Stage {
    /// Number of trees that vote.
    pub fn votes(&self) -> usize {
        self.trees.len()
    }
}

/// A cascade.
#[derive(Clone, Debug, PartialEq)]
pub struct Cascade {
    /// Width of the window, pixels.
    pub width: usize,
    /// Height of the window, pixels.
    pub height: usize,
    /// Features that the cascade looks at.
    pub features: Vec<CascadeFeature>,
    /// The stages in the order in which a window meets them.
    pub stages: Vec<Stage>,
    pub(super) trees: Vec<Tree>,
    pub(super) nodes: Vec<TreeNode>,
    pub(super) leaves: Vec<f32>,
    /// For each node of an LBP cascade, the codes that go left.
    pub(super) subsets: Vec<[u32; 8]>,
}

impl Cascade {
    /// Kind of the features that the cascade looks at.
    pub fn kind(&self) -> CascadeKind {
        kind(&self.features)
    }
}

/// The kind of the features, that of the first; none at all count as Haar.
pub(super) fn kind(features: &[CascadeFeature]) -> CascadeKind {
    features
        .first()
        .map_or(CascadeKind::Haar, CascadeFeature::kind)
}

/// Whether any of the features is turned by 45°.
pub(super) fn any_tilted(features: &[CascadeFeature]) -> bool {
    let tilted = |f: &CascadeFeature| matches!(f, CascadeFeature::Haar(h) if h.tilted);
    features.iter().any(tilted)
}
