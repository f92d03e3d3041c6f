//! A cascade in memory.

use std::ops::Range;

/// A rectangle of the window: left, top, width, height, pixels.
pub(super) type Area = [i32; 4];

/// What a cascade looks at.
#[derive(Clone, Debug, PartialEq)]
pub enum Feature {
    /// Weighted sums of rectangles (Viola and Jones 2001, tilted ones by Lienhart 2002).
    Haar(HaarFeature),
    /// Nine blocks, each compared with the middle one; the first of them: left, top, width, height.
    Lbp(Area),
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
pub(super) struct Node {
    /// Index of the feature.
    pub feature: u32,
    /// Next node of the tree if positive, otherwise the negative index of a leaf.
    pub left: i32,
    /// See `left`.
    pub right: i32,
    /// What a Haar feature is compared with.
    pub threshold: f32,
}

/// Nodes and leaves of a tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Tree {
    pub nodes: Range<usize>,
    pub first_leaf: usize,
}

/// One stage.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// Its trees.
    pub(super) trees: Range<usize>,
    /// Least sum of votes of a window that passes.
    pub threshold: f32,
}

impl Stage {
    /// How many trees vote.
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
    /// What it looks at.
    pub features: Vec<Feature>,
    /// The stages in the order in which a window meets them.
    pub stages: Vec<Stage>,
    pub(super) trees: Vec<Tree>,
    pub(super) nodes: Vec<Node>,
    pub(super) leaves: Vec<f32>,
    /// For each node of an LBP cascade, the codes that go left.
    pub(super) subsets: Vec<[u32; 8]>,
}

impl Cascade {
    /// Whether it looks at local binary patterns.
    pub fn is_lbp(&self) -> bool {
        matches!(self.features.first(), Some(Feature::Lbp(_)))
    }

    /// Whether any of its features is turned by 45°.
    pub fn is_tilted(&self) -> bool {
        let tilted = |f: &Feature| matches!(f, Feature::Haar(h) if h.tilted);
        self.features.iter().any(tilted)
    }
}
