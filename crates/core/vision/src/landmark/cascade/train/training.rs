//! A cascade in the making.

use rand::SeedableRng;
use rand::seq::index;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::super::CascadeFeature;
use super::super::{
    Cascade, CascadeError, NodeSplit, Patch, PatchEvaluator, TrainedStage, TrainedTree, responses,
};
use super::pool::{FeatureKind, pool};
use super::stage::{Growing, StageGoal, StageRow};
use super::table::BinTable;

/// Features of the pool that a stage chooses among: one of few votes, and one of many.
const FEATURES: [usize; 2] = [2500, 5000];
/// From so many votes on they are many.
const MANY_VOTES: usize = 80;

/// Settings of a cascade's training.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingSettings {
    /// Kind of features that the cascade looks at.
    pub kind: FeatureKind,
    /// Width of its window, pixels.
    pub width: usize,
    /// Height of its window, pixels.
    pub height: usize,
    /// Draws the features to choose among.
    pub seed: u64,
}

/// A cascade that grows stage by stage. The caller brings what it still takes for the thing it looks for.
pub struct CascadeTraining {
    settings: TrainingSettings,
    pool: Vec<CascadeFeature>,
    positives: Vec<(Patch, usize)>,
    stages: Vec<TrainedStage>,
    growing: Option<Growing>,
    /// Features that the stage that grows chooses among, numbered within the pool.
    offered: Vec<usize>,
}

impl CascadeTraining {
    /// Begins with the windows that the cascade shall find; each with the number of its group, whose
    /// windows have much in common: a day.
    pub fn new(settings: TrainingSettings, positives: Vec<(Patch, usize)>) -> Self {
        Self {
            pool: pool(
                settings.kind,
                settings.width,
                settings.height,
                settings.seed,
            ),
            settings,
            positives,
            stages: Vec::new(),
            growing: None,
            offered: Vec::new(),
        }
    }

    /// Goes on where another training of the same settings and windows was left after whole stages.
    #[must_use]
    pub fn resumed(mut self, stages: Vec<TrainedStage>) -> Self {
        self.stages = stages;
        self
    }

    /// Whole stages so far, features numbered within the pool.
    pub fn stages(&self) -> &[TrainedStage] {
        &self.stages
    }

    /// State of the stage that grows, if one does.
    pub fn growing(&self) -> Option<StageRow> {
        self.growing.as_ref().map(|g| g.row)
    }

    /// The cascade of the whole stages; `None` before the first.
    ///
    /// # Errors
    /// If the window is too small or too large for a cascade.
    pub fn cascade(&self) -> Result<Option<Cascade>, CascadeError> {
        if self.stages.is_empty() {
            return Ok(None);
        }
        let mut used: Vec<usize> = Vec::new();
        let mut stages = self.stages.clone();
        for node in stages
            .iter_mut()
            .flat_map(|s| &mut s.trees)
            .flat_map(|t| &mut t.nodes)
        {
            let known = used.iter().position(|u| *u == node.feature);
            node.feature = known.unwrap_or_else(|| {
                used.push(node.feature);
                used.len() - 1
            });
        }
        let features = used.iter().map(|i| self.pool[*i].clone()).collect();
        Cascade::from_parts(self.settings.width, self.settings.height, features, &stages).map(Some)
    }

    /// Begins the next stage against windows, with their groups, that the cascade so far lets pass though
    /// it should not.
    ///
    /// # Errors
    /// As [`Self::cascade`].
    pub fn begin_stage(
        &mut self,
        negatives: &[(Patch, usize)],
        goal: StageGoal,
    ) -> Result<(), CascadeError> {
        let cascade = self.cascade()?;
        let passes = |(patch, _): &&(Patch, usize)| {
            cascade.as_ref().is_none_or(|cascade| {
                let stages = responses(cascade, patch.pixels()).stages;
                usize::from(stages.get(1, 1)) == cascade.stages.len()
            })
        };
        let positives: Vec<&(Patch, usize)> = self.positives.iter().filter(passes).collect();
        let count = positives.len();
        let all: Vec<&(Patch, usize)> = positives.into_iter().chain(negatives).collect();
        let windows: Vec<&Patch> = all.iter().map(|(patch, _)| patch).collect();
        let groups: Vec<usize> = all.iter().map(|(_, group)| *group).collect();
        let seed = self.settings.seed ^ self.stages.len() as u64;
        // Many votes need more to choose among than few.
        let most = if goal.most_votes > MANY_VOTES {
            FEATURES[1]
        } else {
            FEATURES[0]
        };
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        self.offered =
            index::sample(&mut random, self.pool.len(), self.pool.len().min(most)).into_vec();
        self.offered.sort_unstable();
        let table = self.table(&windows);
        self.growing = Some(Growing::new(table, count, &groups, goal, seed));
        Ok(())
    }

    fn table(&self, windows: &[&Patch]) -> BinTable {
        let features = self.offered.len();
        let TrainingSettings { width, height, .. } = self.settings;
        let chosen: Vec<CascadeFeature> =
            self.offered.iter().map(|i| self.pool[*i].clone()).collect();
        let evaluator = PatchEvaluator::new(&chosen, width, height);
        if self.settings.kind == FeatureKind::Lbp {
            let mut codes = vec![0_u8; features * windows.len()];
            for (window, row) in windows.iter().zip(codes.chunks_exact_mut(features)) {
                evaluator.codes(window, row);
            }
            BinTable::of_codes(&codes, features)
        } else {
            BinTable::of_numbers(windows.len(), features, |i, row| {
                evaluator.values(windows[i], row);
            })
        }
    }

    /// Adds a vote to the stage that grows; the result of the stage once it is whole, and `None` before that
    /// and if none was begun.
    pub fn vote(&mut self) -> Option<StageRow> {
        let growing = self.growing.as_mut()?;
        if !growing.grow() {
            return None;
        }
        let grown = self.growing.take()?;
        let trees = grown.votes.iter().map(|vote| {
            let split = match vote.split {
                super::stump::SampleSplit::Below(edge) => NodeSplit::Threshold(edge),
                super::stump::SampleSplit::Among(codes) => NodeSplit::Codes(codes),
            };
            TrainedTree::stump(
                self.offered[vote.feature],
                split,
                vote.leaves[0],
                vote.leaves[1],
            )
        });
        let trees: Vec<TrainedTree> = trees.collect();
        if trees.is_empty() {
            // Nothing tells the two apart: the stages so far are all there can be.
            return Some(grown.row);
        }
        self.stages.push(TrainedStage {
            trees,
            threshold: grown.threshold as f32,
        });
        Some(grown.row)
    }
}
