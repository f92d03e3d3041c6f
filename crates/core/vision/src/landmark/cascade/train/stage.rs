//! Training of one stage: as many votes as it takes to let nearly all of what is looked for pass and stop
//! most else.

use serde::{Deserialize, Serialize};

use super::boost::Boosting;
use super::stump::Stump;
use super::table::BinTable;
use pilotage_base::statistics::chi_square_quantile;

/// Groups of samples of which one is only judged: a stage that knew them all would think too well of itself.
const JUDGED: usize = 5;

/// Goal of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageGoal {
    /// Least share of what is looked for that passes, below one: of what was seen and, by the tail of a normal
    /// distribution, of what was not.
    pub hit_rate: f64,
    /// Greatest share of everything else that passes.
    pub false_alarm_rate: f64,
    /// Most votes.
    pub most_votes: usize,
}

impl Default for StageGoal {
    fn default() -> Self {
        Self {
            hit_rate: 0.999,
            false_alarm_rate: 0.4,
            most_votes: 60,
        }
    }
}

/// Result of a stage.
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
    /// Standard deviations below the mean above which the share of the goal lies.
    deviations: f64,
    pub votes: Vec<Stump>,
    /// Least sum that passes, as it is now.
    pub threshold: f64,
    pub row: StageRow,
}

impl Growing {
    /// Of a table with the positives first; samples of a `group` have much in common.
    pub fn new(
        table: BinTable,
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
            // Of a normal distribution, by the square of it.
            deviations: chi_square_quantile(
                (2.0 * goal.hit_rate - 1.0).clamp(0.0, 1.0 - 1e-9),
                1.0,
            )
            .sqrt(),
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

    /// Adds a vote. True once the goal is reached or no further vote helps.
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
        // Low enough for nearly all that was seen, and for what was not by the tail of those that no vote
        // was fitted to: the lowest that was seen says little about what will be.
        let mut seen: Vec<f64> = of(1, false).collect();
        seen.sort_unstable_by(f64::total_cmp);
        let missed = ((1.0 - self.goal.hit_rate) * seen.len() as f64).floor() as usize;
        let least = seen.get(missed).copied().unwrap_or(f64::INFINITY);
        let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
        for value in of(1, true) {
            count += 1.0;
            sum += value;
            squares += value * value;
        }
        let mean = sum / count;
        let tail = mean - self.deviations * (squares / count - mean * mean).max(0.0).sqrt();
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A stage of one vote that parts two kinds of one number each, of which one in fifty of the first
    /// kind looks like the second.
    fn grown(hit_rate: f64) -> StageRow {
        let count = 400;
        let value = |i: usize| {
            let is_first = i < count / 2;
            let is_odd = i.is_multiple_of(50);
            let middle = if is_first && !is_odd { 1.0 } else { -1.0 };
            middle + 0.3 * ((i as f32 * 0.618).fract() - 0.5)
        };
        let table = BinTable::of_numbers(count, 1, |i, row| row[0] = value(i));
        let groups: Vec<usize> = (0..count).map(|i| i % 25).collect();
        let goal = StageGoal {
            hit_rate,
            most_votes: 1,
            ..StageGoal::default()
        };
        let mut stage = Growing::new(table, count / 2, &groups, goal, 1);
        while !stage.grow() {}
        stage.row
    }

    #[test]
    fn a_stage_lets_as_many_pass_as_its_goal_says_and_stops_more_the_fewer_must() {
        let all = grown(0.999);
        assert!(
            all.hit_rate >= 0.999 && all.false_alarm_rate > 0.9,
            "{all:?}"
        );
        let most = grown(0.95);
        assert!(most.hit_rate >= 0.95 && most.hit_rate < 1.0, "{most:?}");
        assert!(most.false_alarm_rate < 0.1, "{most:?}");
    }
}
