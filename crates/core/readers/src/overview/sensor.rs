//! Sensors of a flight, their rates, and their gaps.

use serde::{Deserialize, Serialize};

use super::super::interpret::{Role, RoleSeries};

/// Times the usual interval from which on a pause is a gap.
const GAP: f64 = 5.0;
/// Shortest gap that is told, seconds.
const LEAST_GAP: f64 = 1.0;
/// Longest time for which a sensor that moves shows the same number, seconds.
const STUCK: f64 = 5.0;

/// A stretch without samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SampleGap {
    /// Last sample before it, seconds.
    pub from: f64,
    /// First sample after it, seconds.
    pub to: f64,
}

/// Sensor of a role.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sensor {
    /// The role.
    pub role: Role,
    /// Topic and field.
    pub source: String,
    /// Number of samples.
    pub samples: usize,
    /// Samples per second in between gaps: one by the median interval, 0 with fewer than two.
    pub rate: f64,
    /// Stretches without samples that are five times longer than usual and at least a second.
    pub gaps: Vec<SampleGap>,
    /// The longest stretch with one and the same number where the number should move, seconds.
    pub stuck: Option<(f64, f64)>,
    /// Whether it shows one number for the whole log, though nothing holds it still.
    pub is_dead: bool,
}

impl Sensor {
    /// Looks a series over.
    pub fn of(series: &RoleSeries) -> Self {
        let steps = series.times.windows(2).map(|w| w[1] - w[0]);
        let mut intervals: Vec<f64> = steps.collect();
        let gaps_from = |usual: f64| {
            let longest = (GAP * usual).max(LEAST_GAP);
            let pairs = series.times.windows(2);
            let gaps = pairs.filter(move |w| w[1] - w[0] > longest);
            gaps.map(|w| SampleGap {
                from: w[0],
                to: w[1],
            })
        };
        let middle = intervals.len() / 2;
        let usual = (!intervals.is_empty())
            .then(|| *intervals.select_nth_unstable_by(middle, f64::total_cmp).1);
        let first = series.values[0];
        Self {
            role: series.role,
            source: series.source.clone(),
            samples: series.times.len(),
            rate: usual.map_or(0.0, f64::recip),
            gaps: usual.map_or_else(Vec::new, |usual| gaps_from(usual).collect()),
            stuck: stuck(series),
            is_dead: !series.is_held && series.values.iter().all(|v| *v == first),
        }
    }
}

/// So many samples a second in words.
pub(super) fn often(rate: f64) -> String {
    if rate >= 0.95 {
        format!("{rate:.0} a second")
    } else {
        format!("one every {:.0} s", rate.recip())
    }
}

/// The longest stretch of at least five seconds and ten samples with one number, where the number should
/// move: what measures motion never rests on all its digits.
fn stuck(series: &RoleSeries) -> Option<(f64, f64)> {
    let moves = matches!(
        series.role,
        Role::Airspeed
            | Role::Heading
            | Role::Roll
            | Role::Pitch
            | Role::RollRate
            | Role::PitchRate
            | Role::YawRate
    );
    if !moves || series.is_held {
        return None;
    }
    let mut best: Option<(usize, usize)> = None;
    let mut from = 0;
    for i in 1..=series.values.len() {
        if series.values.get(i) == Some(&series.values[from]) {
            continue;
        }
        let length = |(a, b): (usize, usize)| series.times[b] - series.times[a];
        let run = (from, i - 1);
        let is_zero = series.values[from] == 0.0;
        if i - from >= 10
            && !is_zero
            && length(run) >= STUCK
            && best.is_none_or(|best| length(run) > length(best))
        {
            best = Some(run);
        }
        from = i;
    }
    best.map(|(a, b)| (series.times[a], series.times[b]))
}
