//! Quantiles of values in any order.

use pilotage_base::statistics;

/// The value that the share `share` of the values stays below, between the nearest two; 0 of none.
///
/// ```
/// use pilotage_navigator::instruments::quantile;
///
/// assert_eq!(quantile(vec![4.0, 1.0, 2.0, 3.0, 5.0], 0.5), 3.0);
/// assert!((quantile(vec![0.0, 10.0], 0.95) - 9.5).abs() < 1e-12);
/// assert_eq!(quantile(Vec::new(), 0.5), 0.0);
/// ```
pub fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    statistics::quantile(&values, share).unwrap_or(0.0)
}

/// The quantile of all values but one that is `value`; 0 of none. `sorted` are the values, the least first.
///
/// An outlier among few is no measure of what is usual.
pub fn quantile_of_others(sorted: &[f64], value: f64, share: f64) -> f64 {
    let mut others = sorted.to_vec();
    let at = others.partition_point(|other| *other < value);
    if at < others.len() {
        others.remove(at);
    }
    statistics::quantile(&others, share).unwrap_or(0.0)
}
