//! Shares with their uncertainty.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Standard deviations within which 95 % of a normal variable lie.
pub(super) const NORMAL_95: f64 = 1.959_963_984_540_054;

/// A figure with its two-sided 95 % interval.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct IntervalEstimate {
    /// The figure.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

/// Rate of an event, with the two-sided 95 % interval of the share behind it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rate {
    /// Number of times that it happened.
    pub happened: usize,
    /// Number of times that it could have happened.
    pub of: usize,
    /// Lower end of the interval of the share.
    pub low: f64,
    /// Upper end of the interval of the share.
    pub high: f64,
}

impl Rate {
    /// Of tries that know nothing of each other.
    pub fn independent(happened: usize, of: usize) -> Self {
        Self::with_effect(happened, of, 1.0)
    }

    /// Of tries that come in clusters: counts (happened, of) by cluster, which go together as
    /// `correlation` within a cluster says.
    ///
    /// The interval is that of as many independent tries as are worth the same: n over the design
    /// effect 1 + (m - 1) ρ, m the mean size of the cluster that a try lies in (Kish 1965, 8.2).
    ///
    /// ```
    /// use pilotage_training::evaluation::{Rate, wilson};
    ///
    /// // Five days of ten tries that all go the same way are worth five tries.
    /// let days = [(10, 10), (10, 10), (10, 10), (0, 10), (0, 10)];
    /// let rate = Rate::clustered(&days, 1.0);
    /// assert_eq!(rate.share(), Some(0.6));
    /// let (low, high) = wilson(3.0, 5.0);
    /// assert!((rate.low - low).abs() < 1e-9 && (rate.high - high).abs() < 1e-9);
    /// ```
    pub fn clustered(clusters: &[(usize, usize)], correlation: f64) -> Self {
        let (happened, of) = totals(clusters);
        let squares: f64 = clusters.iter().map(|c| (c.1 as f64).powi(2)).sum();
        let mean_size = squares / (of as f64).max(1.0);
        let effect = 1.0 + (mean_size - 1.0).max(0.0) * correlation;
        Self::with_effect(happened, of, effect)
    }

    fn with_effect(happened: usize, of: usize, effect: f64) -> Self {
        let worth = of as f64 / effect.max(1.0);
        let share = happened as f64 / (of as f64).max(1.0);
        let (low, high) = wilson(share * worth, worth);
        Self {
            happened,
            of,
            low,
            high,
        }
    }

    /// The share, `None` where nothing could have happened.
    pub fn share(&self) -> Option<f64> {
        (self.of > 0).then(|| self.happened as f64 / self.of as f64)
    }
}

/// Wilson's 95 % interval (Wilson 1927) of a share, after `happened` of `of` tries; neither need be
/// whole. From 0 to 1 without tries.
///
/// ```
/// use pilotage_training::evaluation::wilson;
///
/// // 45 of 50, by the printed formula: 0.786 to 0.957.
/// let (low, high) = wilson(45.0, 50.0);
/// assert!((low - 0.7864).abs() < 1e-4 && (high - 0.9565).abs() < 1e-4);
/// ```
pub fn wilson(happened: f64, of: f64) -> (f64, f64) {
    if of <= 0.0 {
        return (0.0, 1.0);
    }
    let z2 = NORMAL_95 * NORMAL_95;
    let share = happened / of;
    let middle = (share + 0.5 * z2 / of) / (1.0 + z2 / of);
    let half =
        NORMAL_95 / (1.0 + z2 / of) * (share * (1.0 - share) / of + z2 / (4.0 * of * of)).sqrt();
    // At both ends the interval touches them; rounding must not leave a gap.
    let low = if happened <= 0.0 { 0.0 } else { middle - half };
    let high = if happened >= of { 1.0 } else { middle + half };
    (low.max(0.0), high.min(1.0))
}

/// Correlation of the tries within a cluster, 0 (as any two) to 1 (all the same), from counts (happened, of)
/// by cluster: the analysis-of-variance estimate (Ridout, Demétrio and Firth 1999, eq. 2).
///
/// ```
/// use pilotage_training::evaluation::correlation_within;
///
/// // All or nothing within a day; and the same share on every day.
/// assert!((correlation_within(&[(10, 10), (0, 10), (10, 10), (0, 10)]) - 1.0).abs() < 1e-9);
/// assert_eq!(correlation_within(&[(5, 10), (5, 10), (5, 10)]), 0.0);
/// ```
pub fn correlation_within(clusters: &[(usize, usize)]) -> f64 {
    let filled: Vec<_> = clusters.iter().filter(|c| c.1 > 0).collect();
    let k = filled.len() as f64;
    let (happened, of) = totals(clusters);
    let (happened, n) = (happened as f64, of as f64);
    if k < 2.0 || n <= k {
        return 0.0;
    }
    let by_cluster: f64 = (filled.iter().map(|c| (c.0 as f64).powi(2) / c.1 as f64)).sum();
    let squares: f64 = filled.iter().map(|c| (c.1 as f64).powi(2)).sum();
    let between = (by_cluster - happened * happened / n) / (k - 1.0);
    let within = (happened - by_cluster) / (n - k);
    let size = (n - squares / n) / (k - 1.0);
    let correlation = (between - within) / (between + (size - 1.0) * within);
    if correlation.is_finite() {
        correlation.clamp(0.0, 1.0)
    } else {
        0.0
    }
}

/// Counts (happened, could have happened) by day, of tries with their day.
pub(super) fn counts_by_day(
    tries: impl Iterator<Item = (usize, (bool, bool))>,
) -> Vec<(usize, usize)> {
    let mut days = BTreeMap::<usize, (usize, usize)>::new();
    for (day, (happened, possible)) in tries {
        let day = days.entry(day).or_default();
        day.0 += usize::from(happened);
        day.1 += usize::from(possible);
    }
    days.into_values().collect()
}

fn totals(clusters: &[(usize, usize)]) -> (usize, usize) {
    let add = |sum: (usize, usize), c: &(usize, usize)| (sum.0 + c.0, sum.1 + c.1);
    clusters.iter().fold((0, 0), add)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_solves_wilsons_equation() {
        // The ends p are where (share - p)² = z² p (1 - p) / n.
        let (low, high) = wilson(45.0, 50.0);
        for p in [low, high] {
            let distance = (0.9_f64 - p).powi(2);
            let allowed = NORMAL_95.powi(2) * p * (1.0 - p) / 50.0;
            assert!((distance - allowed).abs() < 1e-12, "{p}");
        }
        assert_eq!(wilson(0.0, 20.0).0, 0.0);
        assert_eq!(wilson(20.0, 20.0).1, 1.0);
        assert_eq!(wilson(0.0, 0.0), (0.0, 1.0));
    }

    #[test]
    fn tries_that_all_go_as_their_day_goes_are_worth_one_a_day() {
        let days: Vec<_> = (0..20).map(|d| (if d < 16 { 30 } else { 0 }, 30)).collect();
        let correlation = correlation_within(&days);
        assert!(correlation > 0.99, "{correlation}");
        let rate = Rate::clustered(&days, correlation);
        let (low, high) = wilson(16.0, 20.0);
        assert!((rate.low - low).abs() < 0.01 && (rate.high - high).abs() < 0.01);
        assert_eq!(rate.share(), Some(0.8));
    }

    #[test]
    fn days_that_differ_no_more_than_chance_cost_nothing() {
        let days = [(27, 30), (28, 30), (26, 30), (27, 30), (27, 30)];
        assert_eq!(correlation_within(&days), 0.0);
        let rate = Rate::clustered(&days, 0.0);
        assert_eq!(rate, Rate::independent(135, 150));
    }
}
