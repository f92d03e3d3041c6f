//! Answers of a stage's features on one patch.

use serde::{Deserialize, Serialize};

use super::grid::RowGrid;
use super::layout::{FeatureLayout, FeatureTables};
use super::model::{Cascade, Tree};
use super::patch::Patch;

/// Answer of a feature on a patch, and what follows from it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FeatureAnswer {
    /// Value of a Haar feature, or share of the edges of a HOG one; an LBP code, 0 to 255.
    pub value: f32,
    /// Threshold with which the value is compared; none for an LBP code, which is in a set or not.
    pub threshold: Option<f32>,
    /// The vote of its tree, to which every feature of that tree leads.
    pub vote: f32,
}

/// Answers of the features of a stage in the order of [`super::stage_features`]; empty if there is no
/// such stage, or if the patch is so flat that the scan refuses it unseen.
///
/// # Panics
/// If `patch` is not as large as the cascade's window.
pub fn stage_answers(cascade: &Cascade, stage: usize, patch: &Patch) -> Vec<FeatureAnswer> {
    let (width, height) = (cascade.width, cascade.height);
    assert_eq!((patch.width(), patch.height()), (width, height));
    let grid = RowGrid::new(width + 2, 1);
    let layout = FeatureLayout::new(&cascade.features, width, height, grid);
    let tables = layout.tables(patch.pixels());
    let at = grid.place(1, 1);
    let (Some(stage), Some(factor)) = (cascade.stages.get(stage), layout.factor(&tables, at))
    else {
        return Vec::new();
    };
    let seen = Seen {
        cascade,
        layout,
        tables,
        at,
        factor,
    };
    let trees = cascade.trees[stage.trees.clone()].iter();
    trees.flat_map(|tree| seen.answers(tree)).collect()
}

struct Seen<'a> {
    cascade: &'a Cascade,
    layout: FeatureLayout,
    tables: FeatureTables,
    at: usize,
    factor: f32,
}

impl Seen<'_> {
    fn answers(&self, tree: &Tree) -> Vec<FeatureAnswer> {
        let vote = self.vote(tree);
        let answer = |index: usize| FeatureAnswer {
            value: self.value(index),
            threshold: (self.cascade.subsets.get(index))
                .is_none()
                .then(|| self.cascade.nodes[index].threshold),
            vote,
        };
        tree.nodes.clone().map(answer).collect()
    }

    fn value(&self, index: usize) -> f32 {
        let feature = self.cascade.nodes[index].feature as usize;
        self.layout
            .value(&self.tables, feature, self.at, self.factor)
    }

    fn vote(&self, tree: &Tree) -> f32 {
        let mut next = 0;
        loop {
            let index = tree.nodes.start + next as usize;
            let node = &self.cascade.nodes[index];
            let left = match self.cascade.subsets.get(index) {
                Some(subset) => {
                    let feature = node.feature as usize;
                    let code = self.layout.code(&self.tables, feature, self.at);
                    subset[code >> 5] >> (code & 31) & 1 == 1
                }
                None => self.value(index) < node.threshold,
            };
            next = if left { node.left } else { node.right };
            if next <= 0 {
                return self.cascade.leaves[tree.first_leaf + next.unsigned_abs() as usize];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landmark::cascade::{
        CascadeFeature, HaarFeature, NodeSplit, TrainedStage, TrainedTree, responses,
        stage_features,
    };
    use pilotage_raster::raster::Raster;

    fn picture() -> Raster<u8> {
        Raster::from_fn(40, 30, |x, y| {
            ((x * 37 + y * 91 + x * y * 5) % 200) as u8 + u8::from(x > 20) * 40
        })
    }

    /// Two stages of two stumps each, which ask any window something and refuse none.
    fn cascade(features: Vec<CascadeFeature>, split: &NodeSplit) -> Cascade {
        let stump =
            |feature, sign: f32| TrainedTree::stump(feature, *split, -0.3 * sign, 0.7 * sign);
        let stage = |sign| TrainedStage {
            trees: vec![stump(0, sign), stump(1, 2.0 * sign)],
            threshold: -10.0,
        };
        Cascade::from_parts(12, 12, features, &[stage(1.0), stage(-0.5)]).unwrap()
    }

    /// The votes told for each window must add up to what the scan says of it.
    fn votes_add_up(cascade: &Cascade) {
        let picture = picture();
        let said = responses(cascade, &picture);
        for (x, y) in [(0, 0), (7, 11), (28, 18)] {
            let patch = Patch::cut(&picture, x, y, 12, 12).unwrap();
            let mut sum = 0.0;
            for stage in 0..cascade.stages.len() {
                let answers = stage_answers(cascade, stage, &patch);
                assert_eq!(answers.len(), stage_features(cascade, stage).len());
                sum += answers.iter().map(|a| f64::from(a.vote)).sum::<f64>();
                sum -= f64::from(cascade.stages[stage].threshold);
            }
            let score = f64::from(said.score.get(x, y));
            assert!((sum - score).abs() < 1e-4, "{sum} for {score}");
        }
    }

    #[test]
    fn the_votes_of_every_kind_of_feature_add_up_to_the_score_of_the_window() {
        let hog = |component| CascadeFeature::Hog {
            cell: [0, 0, 6, 6],
            component,
        };
        votes_add_up(&cascade(vec![hog(3), hog(20)], &NodeSplit::Threshold(0.02)));
        let haar = |tilted| {
            CascadeFeature::Haar(HaarFeature {
                areas: [
                    ([4, 1, 4, 4], -1.0),
                    ([4, 1, 2, 4], 2.0),
                    ([0, 0, 1, 1], 0.0),
                ],
                tilted,
            })
        };
        votes_add_up(&cascade(
            vec![haar(false), haar(true)],
            &NodeSplit::Threshold(0.0),
        ));
        let lbp = |x| CascadeFeature::Lbp([x, 1, 3, 3]);
        let codes = NodeSplit::Codes([0x0f0f_3535, 7, 0xffff, 0, 0x1234_5678, 1, 99, 0xff00_0000]);
        votes_add_up(&cascade(vec![lbp(0), lbp(2)], &codes));
    }

    #[test]
    fn a_flat_patch_is_asked_nothing() {
        let haar = CascadeFeature::Haar(HaarFeature {
            areas: [([0, 0, 4, 4], -1.0), ([0, 0, 2, 4], 2.0), ([0; 4], 0.0)],
            tilted: false,
        });
        let cascade = cascade(vec![haar.clone(), haar], &NodeSplit::Threshold(0.0));
        let flat = Patch::with_margin(Raster::filled(14, 14, 90)).unwrap();
        assert!(stage_answers(&cascade, 0, &flat).is_empty());
        assert!(stage_answers(&cascade, 5, &flat).is_empty());
    }
}
