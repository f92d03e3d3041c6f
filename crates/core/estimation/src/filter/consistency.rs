//! Consistency of a filter with its own covariance: statistics of NIS and NEES.

use serde::{Deserialize, Serialize};

use pilotage_base::statistics::chi_square_quantile;

/// Share of the statistics that the bounds enclose when the filter is honest.
const ENCLOSED: f64 = 0.95;

/// Gathers normalised squared errors (NIS or NEES), whose sizes may differ from sample to sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Consistency {
    count: usize,
    inside: usize,
    sum: f64,
    sum_of_dof: f64,
}

/// Statistics of the samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ConsistencySummary {
    /// Number of samples.
    pub count: usize,
    /// Mean of the samples.
    pub mean: f64,
    /// Mean degrees of freedom: the mean that an honest filter has.
    pub dof: f64,
    /// Lower end of the two-sided 95 % interval of the mean, were all samples independent.
    pub lower_95: f64,
    /// Upper end of that interval.
    pub upper_95: f64,
    /// Share of the single samples inside their own two-sided 95 % interval.
    pub inside_95: f64,
}

impl ConsistencySummary {
    /// Whether the mean lies inside its bounds.
    pub fn is_consistent(&self) -> bool {
        (self.lower_95..=self.upper_95).contains(&self.mean)
    }
}

impl Consistency {
    /// Adds a sample with `dof` degrees of freedom. What is not finite counts as outside.
    pub fn push(&mut self, value: f64, dof: usize) {
        let (lower, upper) = chi_square_interval(dof as f64);
        self.count += 1;
        self.inside += usize::from((lower..=upper).contains(&value));
        self.sum += value;
        self.sum_of_dof += dof as f64;
    }

    /// Adds all samples of another.
    pub fn merge(&mut self, other: &Self) {
        self.count += other.count;
        self.inside += other.inside;
        self.sum += other.sum;
        self.sum_of_dof += other.sum_of_dof;
    }

    /// Number of samples.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The summary for independent samples (NIS of one run), or `None` without samples.
    ///
    /// ```
    /// use pilotage_estimation::filter::Consistency;
    ///
    /// let mut nees = Consistency::default();
    /// for value in [1.0, 2.0, 3.0] {
    ///     nees.push(value, 2);
    /// }
    /// let summary = nees.summary().ok_or("no samples")?;
    /// assert_eq!((summary.mean, summary.dof), (2.0, 2.0));
    /// // Chi-square with 6 degrees of freedom lies within 1.237 and 14.449, its third therefore within:
    /// assert!((summary.lower_95 - 1.237 / 3.0).abs() < 1e-3);
    /// assert!((summary.upper_95 - 14.449 / 3.0).abs() < 1e-3);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn summary(&self) -> Option<ConsistencySummary> {
        self.summary_of_runs(self.count)
    }

    /// The summary when only `independent` of the samples are independent of each other, or `None`
    /// without samples.
    ///
    /// The errors of neighbouring steps of one run are alike, so that the mean NEES over R runs
    /// scatters as that of R samples rather than of R times the steps; this is the careful choice.
    pub fn summary_of_runs(&self, independent: usize) -> Option<ConsistencySummary> {
        if self.count == 0 || independent == 0 {
            return None;
        }
        let count = self.count as f64;
        let dof = self.sum_of_dof / count;
        let (lower, upper) = mean_interval(dof, independent);
        Some(ConsistencySummary {
            count: self.count,
            mean: self.sum / count,
            dof,
            lower_95: lower,
            upper_95: upper,
            inside_95: self.inside as f64 / count,
        })
    }
}

/// Two-sided 95 % interval of a chi-square variable.
pub fn chi_square_interval(dof: f64) -> (f64, f64) {
    let tail = 0.5 * (1.0 - ENCLOSED);
    (
        chi_square_quantile(tail, dof),
        chi_square_quantile(1.0 - tail, dof),
    )
}

/// Two-sided 95 % interval of the mean of `samples` independent chi-square variables.
pub fn mean_interval(dof: f64, samples: usize) -> (f64, f64) {
    let samples = samples as f64;
    let (lower, upper) = chi_square_interval(dof * samples);
    (lower / samples, upper / samples)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bounds_of_the_mean_are_those_of_bar_shalom() {
        // Bar-Shalom, Li and Kirubarajan 2001, example of 50 runs with 2 degrees of freedom:
        // the sum lies in [74.2, 129.6].
        let (lower, upper) = mean_interval(2.0, 50);
        assert!((lower - 1.484).abs() < 1e-3, "{lower}");
        assert!((upper - 2.591).abs() < 1e-3, "{upper}");
    }

    #[test]
    fn samples_of_different_size_are_weighed_by_their_degrees_of_freedom() {
        let mut nis = Consistency::default();
        nis.push(2.0, 2);
        nis.push(6.0, 6);
        nis.push(1000.0, 4);
        nis.push(f64::NAN, 4);
        let summary = nis.summary().unwrap();
        assert_eq!(summary.dof, 4.0);
        assert_eq!(summary.inside_95, 0.5);
        assert!(!summary.is_consistent());
    }

    #[test]
    fn no_samples_have_no_summary() {
        assert_eq!(Consistency::default().summary(), None);
    }
}
