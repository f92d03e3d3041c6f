//! Cascades from what a trainer found.

use serde::{Deserialize, Serialize};

use super::CascadeError;
use super::check::empty;
use super::model::{Cascade, CascadeFeature, CascadeKind, TreeNode, kind};
use super::read::THRESHOLD_SLACK;

/// Decision of a tree's node.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum NodeSplit {
    /// Left is what is less (Haar and HOG).
    Threshold(f32),
    /// Left are the codes whose bit is set, code `c` in word `c / 32` at bit `c % 32` (LBP).
    Codes([u32; 8]),
}

/// A node of a tree.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainedNode {
    /// Index of its feature.
    pub feature: usize,
    /// Decision of the node.
    pub split: NodeSplit,
    /// Next on the left: another node of the tree, behind this one, by its index; or a leaf by its index
    /// negated (zero is the first leaf).
    pub left: i32,
    /// Next on the right, in the same way.
    pub right: i32,
}

/// A tree.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainedTree {
    /// Its nodes, the root first.
    pub nodes: Vec<TrainedNode>,
    /// Its votes, one more than nodes.
    pub leaves: Vec<f32>,
}

impl TrainedTree {
    /// A tree of one node.
    pub fn stump(feature: usize, split: NodeSplit, left: f32, right: f32) -> Self {
        let node = TrainedNode {
            feature,
            split,
            left: 0,
            right: -1,
        };
        Self {
            nodes: vec![node],
            leaves: vec![left, right],
        }
    }
}

/// A stage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainedStage {
    /// Its trees.
    pub trees: Vec<TrainedTree>,
    /// Least sum of votes that passes.
    pub threshold: f32,
}

impl Cascade {
    /// A cascade for windows of `width` × `height` pixels.
    ///
    /// Thresholds act as given, except that those of stages may become one bit smaller: the greatest
    /// that OpenCV's files, which subtract 1e-5 from what they hold, can say.
    ///
    /// # Errors
    /// What is refused in a file, too: features that leave the window or are of two kinds, trees that
    /// do not end, numbers that are none; also splits that do not suit the features.
    ///
    /// ```
    /// # use pilotage_raster::raster::Raster;
    /// use pilotage_vision::landmark::cascade::{
    ///     Cascade, CascadeFeature, HaarFeature, NodeSplit, TrainedStage, TrainedTree, responses,
    /// };
    ///
    /// // The right half less the left half of a window of 24 × 24 pixels.
    /// let areas = [([0, 0, 24, 24], -1.0), ([12, 0, 12, 24], 2.0), ([0, 0, 0, 0], 0.0)];
    /// let feature = CascadeFeature::Haar(HaarFeature { areas, tilted: false });
    /// let trees = vec![TrainedTree::stump(0, NodeSplit::Threshold(0.1), 0.0, 1.0)];
    /// let cascade = Cascade::from_parts(24, 24, vec![feature], &[TrainedStage { trees, threshold: 0.5 }])?;
    /// // An edge at column 40 lies in the middle of the window that begins at column 28.
    /// let picture = Raster::from_fn(80, 24, |column, _| if column < 40 { 20 } else { 220 });
    /// let stages = responses(&cascade, &picture).stages;
    /// assert_eq!((stages.get(28, 0), stages.get(0, 0)), (1, 0));
    /// # Ok::<(), pilotage_vision::landmark::cascade::CascadeError>(())
    /// ```
    pub fn from_parts(
        width: usize,
        height: usize,
        features: Vec<CascadeFeature>,
        stages: &[TrainedStage],
    ) -> Result<Self, CascadeError> {
        let fail = |place: String| move |cause| CascadeError::Parts { place, cause };
        let with_codes = kind(&features) == CascadeKind::Lbp;
        let mut cascade =
            empty(width as i64, height as i64).map_err(fail("the window".to_owned()))?;
        for (i, feature) in features.into_iter().enumerate() {
            cascade
                .add_feature(feature)
                .map_err(fail(format!("feature {i}")))?;
        }
        for (s, stage) in stages.iter().enumerate() {
            let first_tree = cascade.trees.len();
            for (t, tree) in stage.trees.iter().enumerate() {
                cascade
                    .add_tree(tree, with_codes)
                    .map_err(fail(format!("stage {s}, tree {t}")))?;
            }
            cascade
                .end_stage(first_tree, writable(stage.threshold).1)
                .map_err(fail(format!("stage {s}")))?;
        }
        cascade.check().map_err(fail("the cascade".to_owned()))
    }

    fn add_tree(&mut self, tree: &TrainedTree, with_codes: bool) -> Result<(), String> {
        let mut nodes = Vec::with_capacity(tree.nodes.len());
        for node in &tree.nodes {
            let threshold = match node.split {
                NodeSplit::Threshold(threshold) if !with_codes => threshold,
                NodeSplit::Codes(codes) if with_codes => {
                    self.subsets.push(codes);
                    0.0
                }
                _ => return Err("a split that does not suit the feature".to_owned()),
            };
            nodes.push(TreeNode {
                feature: u32::try_from(node.feature).unwrap_or(u32::MAX),
                left: node.left,
                right: node.right,
                threshold,
            });
        }
        self.grow(&nodes, &tree.leaves)
    }
}

/// Threshold to write in a file for a stage's threshold to act, and the threshold that then acts: as wished,
/// or where no number does that, by the least amount less.
pub(super) fn writable(acting: f32) -> (f32, f32) {
    let mut written = acting + THRESHOLD_SLACK;
    while written - THRESHOLD_SLACK < acting {
        written = written.next_up();
    }
    while written - THRESHOLD_SLACK > acting {
        written = written.next_down();
    }
    (written, written - THRESHOLD_SLACK)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn stump(feature: usize, split: NodeSplit) -> Vec<TrainedStage> {
        vec![TrainedStage {
            trees: vec![TrainedTree::stump(feature, split, -1.0, 1.0)],
            threshold: 0.0,
        }]
    }

    #[test]
    fn what_a_trainer_must_not_say_is_refused_and_named() {
        let lbp = || vec![CascadeFeature::Lbp([0, 0, 4, 4])];
        let hog = |cell, component| vec![CascadeFeature::Hog { cell, component }];
        let said = |features: Vec<CascadeFeature>, stages: &[TrainedStage]| {
            let cascade = Cascade::from_parts(12, 12, features, stages);
            cascade.expect_err("refused").to_string()
        };
        let codes = NodeSplit::Codes([0; 8]);
        assert!(said(lbp(), &[]).contains("no stage"));
        assert!(said(lbp(), &stump(1, codes)).contains("feature 1 of 1"));
        assert!(said(lbp(), &stump(0, NodeSplit::Threshold(0.0))).contains("does not suit"));
        let threshold = NodeSplit::Threshold(f32::NAN);
        assert!(said(hog([0, 0, 6, 6], 0), &stump(0, threshold)).contains("NaN"));
        assert!(said(hog([0, 0, 7, 6], 0), &[]).contains("leaves the window"));
        assert!(said(hog([0, 0, 6, 6], 36), &[]).contains("component 36"));
        let mixed = [lbp(), hog([0, 0, 6, 6], 0)].concat();
        assert!(said(mixed, &[]).contains("two kinds"));
        assert!(Cascade::from_parts(12, 12, lbp(), &stump(0, codes)).is_ok());
    }

    proptest! {
        #[test]
        fn a_stages_threshold_acts_as_wished_or_by_a_bit_less(wished in -50.0_f32..50.0) {
            let (written, acting) = writable(wished);
            prop_assert_eq!(written - THRESHOLD_SLACK, acting);
            prop_assert!(acting <= wished && acting >= wished.next_down().next_down());
            prop_assert_eq!(writable(acting).1, acting);
        }
    }
}
