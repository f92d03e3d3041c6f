//! Ranks between which a quantile lies, by the binomial law.

/// Share of the binomial law that lies beyond each of the two ranks, at most.
const TAIL: f64 = 0.025;
/// Weight, of that at the mode, below which the rest of the law is nothing to a number of double precision.
const NOTHING: f64 = 1e-20;

/// Ranks, counted from 0, of those two of `count` sorted independent draws between which the quantile of `share` lies with
/// 95 % at least, whatever the law of the draws: the number of draws below it is binomial. `None` where no draw bounds it
/// on a side, as they are too few.
///
/// ```
/// use pilotage_base::statistics::quantile_ranks;
///
/// // The median of six lies outside of them once in 32, and that of five once in 16.
/// assert_eq!(quantile_ranks(6, 0.5), Some([0, 5]));
/// assert_eq!(quantile_ranks(5, 0.5), None);
/// ```
pub fn quantile_ranks(count: u64, share: f64) -> Option<[u64; 2]> {
    let (first, weights) = binomial(count, share);
    let total: f64 = weights.iter().sum();
    let mut sum = 0.0;
    let below = weights.iter().map(|weight| {
        sum += weight;
        sum / total
    });
    let below: Vec<f64> = below.collect();
    // The low rank lies above the quantile where no more draws than that are below it, the high one below it where more are.
    let low = first + below.partition_point(|share| *share <= TAIL) as u64;
    let high = first + below.partition_point(|share| *share < 1.0 - TAIL) as u64;
    (low > 0 && high < count).then(|| [low - 1, high])
}

/// Weights of the binomial numbers from the first that has one, up to a factor.
fn binomial(count: u64, share: f64) -> (u64, Vec<f64>) {
    let odds = share / (1.0 - share);
    let mode = (((count + 1) as f64 * share) as u64).min(count);
    let mut weights = vec![1.0];
    let (mut first, mut weight) = (mode, 1.0);
    while first > 0 && weight > NOTHING {
        weight *= first as f64 / ((count - first + 1) as f64 * odds);
        first -= 1;
        weights.push(weight);
    }
    weights.reverse();
    let (mut last, mut weight) = (mode, 1.0);
    while last < count && weight > NOTHING {
        weight *= (count - last) as f64 * odds / (last + 1) as f64;
        last += 1;
        weights.push(weight);
    }
    (first, weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_hold_a_quantile_as_often_as_they_say_and_are_those_of_scipy() {
        // Coverage by the law itself, from its logarithms.
        let coverage = |count: u64, share: f64, [low, high]: [u64; 2]| -> f64 {
            let mut log_choose = 0.0;
            let term = |k: u64| {
                let n = count as f64;
                let log = log_choose + k as f64 * share.ln() + (n - k as f64) * (1.0 - share).ln();
                log_choose += ((n - k as f64) / (k as f64 + 1.0)).ln();
                log.exp()
            };
            let terms: Vec<f64> = (0..=count).map(term).collect();
            terms[low as usize + 1..=high as usize].iter().sum()
        };
        for share in [0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99] {
            for count in 1..=400 {
                let Some(ranks) = quantile_ranks(count, share) else {
                    // Not even all of the draws would hold it.
                    let all = share
                        .powi(count as i32)
                        .max((1.0 - share).powi(count as i32));
                    assert!(all > TAIL, "{count} {share}");
                    continue;
                };
                let held = coverage(count, share, ranks);
                assert!(held >= 0.95, "{count} {share} {ranks:?}: {held}");
                // No narrower pair of the same kind does.
                let [low, high] = ranks;
                assert!(coverage(count, share, [low + 1, count]) < 1.0 - TAIL);
                assert!(high == 0 || coverage(count, share, [0, high - 1]) < 0.975);
            }
        }
        // By SciPy's binomial law.
        assert_eq!(quantile_ranks(16, 0.5), Some([3, 12]));
        assert_eq!(quantile_ranks(100, 0.5), Some([39, 60]));
        assert_eq!(quantile_ranks(200, 0.95), Some([183, 196]));
        assert_eq!(quantile_ranks(72, 0.95), Some([63, 71]));
        assert_eq!(quantile_ranks(71, 0.95), None);
        // Of very many, those of the normal law: 1.96 × √(10⁶ / 4) = 980.
        assert_eq!(quantile_ranks(1_000_000, 0.5), Some([499_019, 500_980]));
    }
}
