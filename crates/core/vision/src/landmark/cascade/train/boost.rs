//! `GentleBoost`: one vote after the other, each for what the others got wrong.

use rand::SeedableRng;
use rand::seq::index;
use rand_chacha::ChaCha8Rng;

use super::stump::{Stump, best_stump};
use super::table::BinTable;

/// Share of the weight that a vote may leave out: that of the samples that are right anyway (weight
/// trimming, Friedman, Hastie and Tibshirani 2000).
const TRIMMED: f64 = 0.01;

/// Features that a vote chooses among, drawn anew for each (`LazyBoost`, Escudero, Màrquez and Rigau 2000):
/// the best of many hardly differs from the best of all.
const OFFERED: usize = 1500;

/// Samples of two kinds that votes are found for.
pub(super) struct Boosting {
    table: BinTable,
    /// 1 for what shall be found, -1 for what shall not.
    pub targets: Vec<i8>,
    /// Samples that votes are fitted to; the others are only judged.
    pub fitted: Vec<bool>,
    weights: Vec<f64>,
    random: ChaCha8Rng,
    /// Sum of the votes for each sample.
    pub sums: Vec<f64>,
}

impl Boosting {
    /// Before the first vote: both kinds weigh the same.
    pub fn new(table: BinTable, targets: Vec<i8>, fitted: Vec<bool>, seed: u64) -> Self {
        let count = |kind: i8| {
            let own = targets.iter().zip(&fitted);
            own.filter(|(t, f)| **t == kind && **f).count().max(1) as f64
        };
        let share = [count(1), count(-1)].map(|n| 0.5 / n);
        Self {
            weights: targets.iter().map(|t| share[usize::from(*t < 0)]).collect(),
            sums: vec![0.0; targets.len()],
            table,
            targets,
            fitted,
            random: ChaCha8Rng::seed_from_u64(seed),
        }
    }

    /// Adds a vote and returns it; `None` if no feature tells the samples apart any further.
    pub fn vote(&mut self) -> Option<Stump> {
        let mut order: Vec<u32> = (0..self.targets.len() as u32)
            .filter(|i| self.fitted[*i as usize])
            .collect();
        let weights = &self.weights;
        order.sort_unstable_by(|a, b| {
            weights[*b as usize]
                .total_cmp(&weights[*a as usize])
                .then(a.cmp(b))
        });
        let total: f64 = order.iter().map(|i| weights[*i as usize]).sum();
        let mut kept = 0.0;
        let trimmed = order.iter().position(|i| {
            kept += weights[*i as usize];
            kept >= (1.0 - TRIMMED) * total
        });
        order.truncate(trimmed.map_or(order.len(), |at| at + 1));
        let all = self.table.features();
        let mut offered = index::sample(&mut self.random, all, all.min(OFFERED)).into_vec();
        offered.sort_unstable();
        let (stump, says) = best_stump(&self.table, &offered, &order, weights, &self.targets)?;
        for (i, said) in says.iter().enumerate() {
            self.sums[i] += f64::from(*said);
            self.weights[i] *= (-f64::from(self.targets[i]) * f64::from(*said)).exp();
        }
        Some(stump)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn votes_together_tell_apart_what_no_single_one_can() {
        // A ring around a disk: no line parts them.
        let place = |i: usize| {
            let angle = i as f32 * 2.4;
            let radius = if i.is_multiple_of(2) { 0.4 } else { 1.0 };
            [radius * angle.cos(), radius * angle.sin()]
        };
        let count = 240;
        let values: Vec<f32> = (0..count).flat_map(place).collect();
        let targets: Vec<i8> = (0..count)
            .map(|i| if i % 2 == 0 { 1 } else { -1 })
            .collect();
        let table = BinTable::of_numbers(count, 2, |i, row| {
            row.copy_from_slice(&values[2 * i..2 * i + 2]);
        });
        let fitted: Vec<bool> = (0..count).map(|i| i < 180).collect();
        let mut boosting = Boosting::new(table, targets, fitted, 1);
        let wrong = |boosting: &Boosting| {
            let judged =
                (180..count).filter(|i| boosting.sums[*i] * f64::from(boosting.targets[*i]) <= 0.0);
            judged.count()
        };
        boosting.vote().unwrap();
        let after_one = wrong(&boosting);
        for _ in 0..40 {
            boosting.vote().unwrap();
        }
        assert!(after_one > 10, "{after_one}");
        assert_eq!(wrong(&boosting), 0);
    }
}
