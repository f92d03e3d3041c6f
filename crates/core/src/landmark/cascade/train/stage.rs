//! One stage: as many votes as it takes to let nearly all of what is looked for pass and stop most else.

use serde::{Deserialize, Serialize};

use super::boost::Boosting;
use super::stump::Stump;
use super::table::Table;

/// One group of samples in so many is only judged: a stage that knew them all would think too well of
/// itself.
const JUDGED: usize = 5;
/// How many standard deviations below the mean of what is looked for a stage still lets pass: one in a
/// thousand of a normal distribution lies lower. The lowest that was seen says little about what will be.
const TAIL: f64 = 3.1;

/// What a stage shall come to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageGoal {
    /// Greatest share of everything else that passes.
    pub false_alarm_rate: f64,
    /// Most votes.
    pub most_votes: usize,
}

impl Default for StageGoal {
    fn default() -> Self {
        Self {
            false_alarm_rate: 0.4,
            most_votes: 60,
        }
    }
}

/// How a stage went.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageRow {
    /// Votes it has.
    pub votes: usize,
    /// Share of the positives that pass, of those that came to it.
    pub hit_rate: f64,
    /// Share of the negatives that pass, of those that were only judged.
    pub false_alarm_rate: f64,
    /// Positives that came to it.
    pub positives: usize,
    /// Negatives that came to it.
    pub negatives: usize,
}

/// A stage that grows vote by vote.
pub(super) struct Growing {
    boosting: Boosting,
    goal: StageGoal,
    pub votes: Vec<Stump>,
    /// Least sum that passes, as it is now.
    pub threshold: f64,
    pub row: StageRow,
}

impl Growing {
    /// Of a table with the positives first; samples of a `group` have much in common.
    pub fn new(
        table: Table,
        positives: usize,
        groups: &[usize],
        goal: StageGoal,
        seed: u64,
    ) -> Self {
        let samples = table.samples();
        let targets = (0..samples).map(|i| if i < positives { 1 } else { -1 });
        let fitted = groups.iter().map(|group| group % JUDGED != JUDGED - 1);
        Self {
            boosting: Boosting::new(table, targets.collect(), fitted.collect(), seed),
            goal,
            votes: Vec::new(),
            threshold: f64::NEG_INFINITY,
            row: StageRow {
                votes: 0,
                hit_rate: 1.0,
                false_alarm_rate: 1.0,
                positives,
                negatives: samples - positives,
            },
        }
    }

    /// One vote more. True once the goal is reached or no further vote helps.
    pub fn grow(&mut self) -> bool {
        let Some(vote) = self.boosting.vote() else {
            return true;
        };
        self.votes.push(vote);
        let Boosting {
            sums,
            targets,
            fitted,
            ..
        } = &self.boosting;
        let of = |kind: i8, judged_only: bool| {
            let all = sums.iter().zip(targets).zip(fitted);
            let own = all.filter(move |((_, t), f)| **t == kind && !(judged_only && **f));
            own.map(|((sum, _), _)| *sum)
        };
        // Low enough for all that was seen, and for what was not by the tail of those that no vote was
        // fitted to.
        let least = of(1, false).fold(f64::INFINITY, f64::min);
        let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
        for value in of(1, true) {
            count += 1.0;
            sum += value;
            squares += value * value;
        }
        let mean = sum / count;
        let tail = mean - TAIL * (squares / count - mean * mean).max(0.0).sqrt();
        // Sums of the scan are of single votes in another order of rounding.
        self.threshold = if count > 1.0 { least.min(tail) } else { least } - 1e-4;
        let share = |kind: i8, judged_only: bool| {
            let (mut passed, mut count) = (0_usize, 0_usize);
            for sum in of(kind, judged_only) {
                passed += usize::from(sum >= self.threshold);
                count += 1;
            }
            passed as f64 / count.max(1) as f64
        };
        self.row.votes = self.votes.len();
        self.row.hit_rate = share(1, false);
        self.row.false_alarm_rate = share(-1, true);
        self.row.false_alarm_rate <= self.goal.false_alarm_rate
            || self.votes.len() >= self.goal.most_votes
    }
}
