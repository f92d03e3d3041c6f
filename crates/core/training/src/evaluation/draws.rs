//! Draws of the looks that another sample of days would have held.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::EvaluatedLook;
use super::rate::{NORMAL_95, wilson};
use pilotage_base::statistics::quantile;

/// Days from which on whole days are drawn.
const ENOUGH_DAYS: usize = 5;

/// Draws days anew (with return), and with them their looks: the cluster bootstrap.
///
/// Of k days k - 1 are drawn, which makes the spread that of independent days (Rao and Wu 1988), not
/// (k - 1)/k of it. From under five days little can be said of other days: then as many days as there
/// are, and within each its looks anew, so that the intervals are at least those of the looks.
#[derive(Clone, Debug)]
pub(super) struct DayDraws {
    /// Indices of the looks of each day.
    days: Vec<Vec<usize>>,
    looks: usize,
    random: ChaCha8Rng,
}

impl DayDraws {
    pub fn new(looks: &[EvaluatedLook], seed: u64) -> Self {
        Self {
            days: by_day(looks).into_iter().map(|(_, looks)| looks).collect(),
            looks: looks.len(),
            random: ChaCha8Rng::seed_from_u64(seed),
        }
    }

    /// Whether whole days are drawn.
    pub fn draws_whole_days(&self) -> bool {
        self.days.len() >= ENOUGH_DAYS
    }

    /// The 95 % interval of the drawn values of a share around `value`, which it holds in any case: the
    /// middle of them, as much wider as Student's distribution for so many days is than the normal one.
    /// Where draws hardly differ it is at least Wilson's for `tries` that know nothing of each other.
    pub fn interval(&self, drawn: &mut [f64], value: f64, tries: f64) -> (f64, f64) {
        let (least, greatest) = wilson(value * tries, tries);
        if drawn.is_empty() {
            return (least, greatest);
        }
        let (low, high) = middle_95(drawn);
        let wider = if self.draws_whole_days() {
            student_over_normal(self.days.len() as f64 - 1.0)
        } else {
            1.0
        };
        (
            (value - wider * (value - low)).clamp(0.0, least),
            (value + wider * (high - value)).clamp(greatest, 1.0),
        )
    }

    /// Number of times that each look is in the next sample.
    pub fn next_weights(&mut self) -> Vec<f64> {
        let mut weights = vec![0.0; self.looks];
        let whole = self.draws_whole_days();
        for _ in 0..self.days.len() - usize::from(whole) {
            let day = &self.days[self.random.random_range(0..self.days.len())];
            if whole {
                for &look in day {
                    weights[look] += 1.0;
                }
            } else {
                for _ in 0..day.len() {
                    weights[day[self.random.random_range(0..day.len())]] += 1.0;
                }
            }
        }
        weights
    }
}

/// Days by number, and the indices of their looks.
pub(super) fn by_day(looks: &[EvaluatedLook]) -> Vec<(usize, Vec<usize>)> {
    let mut days = std::collections::BTreeMap::<usize, Vec<usize>>::new();
    for (index, look) in looks.iter().enumerate() {
        days.entry(look.day).or_default().push(index);
    }
    days.into_iter().collect()
}

/// The 97.5 % quantile of Student's distribution over that of the normal one (Abramowitz and Stegun
/// 26.7.5), from four degrees of freedom on within 0.5 %.
fn student_over_normal(dof: f64) -> f64 {
    let z = NORMAL_95;
    let first = (z.powi(2) + 1.0) / 4.0;
    let second = (5.0 * z.powi(4) + 16.0 * z.powi(2) + 3.0) / 96.0;
    let third = (3.0 * z.powi(6) + 19.0 * z.powi(4) + 17.0 * z.powi(2) - 15.0) / 384.0;
    1.0 + first / dof + second / dof.powi(2) + third / dof.powi(3)
}

/// The 2.5 % and 97.5 % quantiles of samples, which are put into another order.
fn middle_95(values: &mut [f64]) -> (f64, f64) {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| quantile(values, share).unwrap_or(f64::NAN);
    (at(0.025), at(0.975))
}

#[cfg(test)]
mod tests {
    use super::super::sample::{look, mark};
    use super::*;

    #[test]
    fn with_many_days_the_looks_of_a_day_come_together() {
        let looks: Vec<_> = (0..60).map(|i| look(i / 10, &[mark(0.5, true)])).collect();
        let mut draws = DayDraws::new(&looks, 3);
        for _ in 0..20 {
            let weights = draws.next_weights();
            assert_eq!(weights.iter().sum::<f64>(), 50.0);
            assert!(
                weights
                    .chunks(10)
                    .all(|day| day.iter().all(|w| *w == day[0]))
            );
        }
    }

    #[test]
    fn with_one_day_its_looks_are_drawn_one_by_one() {
        let looks: Vec<_> = (0..40).map(|_| look(7, &[])).collect();
        let weights = DayDraws::new(&looks, 3).next_weights();
        assert_eq!(weights.iter().sum::<f64>(), 40.0);
        assert!(weights.iter().any(|w| *w > 1.0));
    }

    #[test]
    fn quantiles_lie_between_neighbours() {
        let mut values: Vec<f64> = (0..=1000).rev().map(f64::from).collect();
        assert_eq!(middle_95(&mut values), (25.0, 975.0));
    }

    #[test]
    fn students_quantiles_are_those_of_the_tables() {
        for (dof, quantile) in [(4.0, 2.776), (9.0, 2.262), (29.0, 2.045)] {
            let ours = NORMAL_95 * student_over_normal(dof);
            assert!((ours - quantile).abs() < 0.015, "{dof}: {ours}");
        }
    }

    #[test]
    fn draws_that_are_all_alike_still_leave_an_interval() {
        let looks: Vec<_> = (0..60).map(|i| look(i / 10, &[])).collect();
        let draws = DayDraws::new(&looks, 3);
        let interval = draws.interval(&mut [1.0; 50], 1.0, 60.0);
        assert_eq!(interval, wilson(60.0, 60.0));
    }
}
