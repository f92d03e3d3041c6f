//! Many runs in one table.

use pilotage_core::filter::quantile;
use pilotage_core::navigator::Summary;
use serde::Serialize;

/// Quantiles of one figure over the runs.
#[derive(Clone, Debug, Serialize)]
pub struct Quantiles {
    /// Name of the figure.
    pub figure: &'static str,
    /// Smallest.
    pub min: f64,
    /// Lower quartile.
    pub q25: f64,
    /// Median.
    pub median: f64,
    /// Upper quartile.
    pub q75: f64,
    /// Largest.
    pub max: f64,
    /// Mean.
    pub mean: f64,
}

fn quantiles(figure: &'static str, mut values: Vec<f64>) -> Option<Quantiles> {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| quantile(&values, share);
    Some(Quantiles {
        figure,
        min: *values.first()?,
        q25: at(0.25)?,
        median: at(0.5)?,
        q75: at(0.75)?,
        max: *values.last()?,
        mean: values.iter().sum::<f64>() / values.len() as f64,
    })
}

/// All figures over `summaries`.
pub fn table(summaries: &[Summary]) -> Vec<Quantiles> {
    type Figure = (&'static str, fn(&Summary) -> Option<f64>);
    let figures: [Figure; 13] = [
        ("position_error_m.rms", |s| {
            s.position_error_m.map(|e| e.rms)
        }),
        ("position_error_m.max", |s| {
            s.position_error_m.map(|e| e.max)
        }),
        ("position_bound_m.rms", |s| {
            s.position_bound_m.map(|b| b.rms)
        }),
        ("error_over_bound", |s| s.error_over_bound),
        ("wind_error_mps.rms", |s| s.wind_error_mps.map(|e| e.rms)),
        ("wind_error_after_minute_mps.rms", |s| {
            s.wind_error_after_minute_mps.map(|e| e.rms)
        }),
        ("nees.mean", |s| s.nees.map(|n| n.mean)),
        ("nis.mean / dof", |s| s.nis.map(|n| n.mean / n.dof)),
        ("frames_with_update", |s| Some(s.frames_with_update as f64)),
        ("updates_accepted", |s| Some(s.updates_accepted as f64)),
        ("updates_wrong", |s| s.updates_wrong.map(|w| w as f64)),
        ("ms_per_frame.see", |s| Some(s.ms_per_frame.see)),
        ("ms_per_frame.total", |s| Some(s.ms_per_frame.total)),
    ];
    figures
        .into_iter()
        .filter_map(|(name, of)| quantiles(name, summaries.iter().filter_map(of).collect()))
        .collect()
}

/// Root mean square error over all runs, over the root mean square bound of all runs.
///
/// The bound limits the mean square over an ensemble, not the error of one lucky run: this is the ratio
/// that no estimator brings below 1, but for the scatter of few runs.
pub fn error_over_bound(summaries: &[Summary]) -> Option<f64> {
    let (error, bound) = summaries
        .iter()
        .filter_map(|s| Some((s.position_error_m?.rms, s.position_bound_m?.rms)))
        .fold((0.0, 0.0), |(error, bound), (e, b)| {
            (error + e * e, bound + b * b)
        });
    (bound > 0.0).then(|| (error / bound).sqrt())
}

/// Prints the table for people.
pub fn print(table: &[Quantiles]) {
    println!(
        "{:34} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}",
        "", "min", "25 %", "median", "75 %", "max", "mean"
    );
    for q in table {
        println!(
            "{:34} {:9.3} {:9.3} {:9.3} {:9.3} {:9.3} {:9.3}",
            q.figure, q.min, q.q25, q.median, q.q75, q.max, q.mean
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_lie_between_the_values() {
        let q = quantiles("x", vec![3.0, 1.0, 2.0, 5.0, 4.0]).unwrap();
        assert_eq!(
            (q.min, q.q25, q.median, q.q75, q.max),
            (1.0, 2.0, 3.0, 4.0, 5.0)
        );
    }
}
