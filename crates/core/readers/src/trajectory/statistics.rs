//! Errors in a few numbers.

use serde::{Deserialize, Serialize};

/// The numbers in which evo sums errors up.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorStatistics {
    /// Number of errors.
    pub count: usize,
    /// Root of the mean square.
    pub rmse: f64,
    /// Mean.
    pub mean: f64,
    /// Median; of an even number, the mean of the middle two.
    pub median: f64,
    /// Standard deviation about the mean, with the whole number below the line.
    pub standard_deviation: f64,
    /// Least.
    pub least: f64,
    /// Greatest.
    pub greatest: f64,
    /// Sum of the squares.
    pub sum_of_squares: f64,
}

impl ErrorStatistics {
    /// Of errors that are not negative; `None` without any.
    ///
    /// ```
    /// use pilotage_readers::trajectory::ErrorStatistics;
    ///
    /// let errors = ErrorStatistics::of([3.0, 4.0, 0.0]).ok_or("none")?;
    /// assert_eq!((errors.median, errors.greatest), (3.0, 4.0));
    /// assert!((errors.rmse - (25.0_f64 / 3.0).sqrt()).abs() < 1e-12);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn of(errors: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<f64> = errors.into_iter().collect();
        sorted.sort_by(f64::total_cmp);
        let (least, greatest) = (*sorted.first()?, *sorted.last()?);
        let count = sorted.len() as f64;
        let mean = sorted.iter().sum::<f64>() / count;
        let sum_of_squares: f64 = sorted.iter().map(|e| e * e).sum();
        let spread: f64 = sorted.iter().map(|e| (e - mean).powi(2)).sum();
        let middle = sorted.len() / 2;
        let median = if sorted.len().is_multiple_of(2) {
            0.5 * (sorted[middle - 1] + sorted[middle])
        } else {
            sorted[middle]
        };
        Some(Self {
            count: sorted.len(),
            rmse: (sum_of_squares / count).sqrt(),
            mean,
            median,
            standard_deviation: (spread / count).sqrt(),
            least,
            greatest,
            sum_of_squares,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_summed_up_as_evo_does() {
        let seen = ErrorStatistics::of([3.0, 1.0, 2.0, 6.0]).unwrap();
        assert_eq!((seen.count, seen.least, seen.greatest), (4, 1.0, 6.0));
        assert_eq!(
            (seen.mean, seen.median, seen.sum_of_squares),
            (3.0, 2.5, 50.0)
        );
        assert!((seen.rmse - 12.5_f64.sqrt()).abs() < 1e-12);
        assert!((seen.standard_deviation - 3.5_f64.sqrt()).abs() < 1e-12);
        assert_eq!(ErrorStatistics::of([]), None);
    }
}
