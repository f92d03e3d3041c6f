//! Under which circumstances a landmark is found.

use serde::{Deserialize, Serialize};

use super::rate::{correlation_within, counts_by_day};
use super::{EvaluatedLook, Rate};

/// Most bins between the least and the greatest value.
const BINS: f64 = 8.0;

/// By what looks differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum By {
    /// Height above the ground.
    Height,
    /// Tilt of the camera.
    Tilt,
    /// Error of the assumed heading.
    HeadingError,
    /// Day.
    Day,
    /// Render (0) or real frame (1).
    Source,
}

impl By {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Height,
        Self::Tilt,
        Self::HeadingError,
        Self::Day,
        Self::Source,
    ];

    /// Name of the circumstance, in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Height => "height above ground",
            Self::Tilt => "tilt",
            Self::HeadingError => "heading error",
            Self::Day => "day",
            Self::Source => "render or real frame",
        }
    }

    /// Unit of the bins' edges, empty where they count.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Height => "m",
            Self::Tilt | Self::HeadingError => "deg",
            Self::Day | Self::Source => "",
        }
    }

    /// The value of a look, in that unit.
    pub fn of(self, look: &EvaluatedLook) -> f64 {
        match self {
            Self::Height => look.height,
            Self::Tilt => look.tilt.to_degrees(),
            Self::HeadingError => look.heading_error.to_degrees(),
            Self::Day => look.day as f64,
            Self::Source => f64::from(u8::from(look.real)),
        }
    }

    /// Whether every value is a bin of its own.
    pub fn counts(self) -> bool {
        self.unit().is_empty()
    }
}

/// Looks of about the same circumstances.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CircumstanceBin {
    /// Lower edge, in the unit of [`By::unit`].
    pub low: f64,
    /// Upper edge, itself not in the bin; equal to the lower one where values are counted.
    pub high: f64,
    /// Looks with the landmark in which it was found.
    pub found: Rate,
    /// Looks with a false alarm.
    pub deceived: Rate,
}

impl CircumstanceBin {
    /// Middle of the bin, at which it is drawn.
    pub fn middle(&self) -> f64 {
        0.5 * (self.low + self.high)
    }
}

/// Detections against a circumstance, at one threshold.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DetectionBreakdown {
    /// The circumstance.
    pub by: By,
    /// From the lowest to the highest; bins without a look are left out.
    pub bins: Vec<CircumstanceBin>,
}

impl DetectionBreakdown {
    /// Looks broken down at `threshold`. Where bins are not days, looks of a day go together as they do
    /// over all looks.
    pub fn of(looks: &[EvaluatedLook], by: By, threshold: f64) -> Self {
        let enters = |score: Option<f64>| score.is_some_and(|s| s >= threshold);
        let found = |look: &EvaluatedLook| (enters(look.found_at()), look.present);
        let deceived = |look: &EvaluatedLook| (enters(look.deceived_at()), true);
        let correlation = |what: &dyn Fn(&EvaluatedLook) -> (bool, bool)| match by {
            By::Day => 0.0,
            _ => correlation_within(&by_day(looks.iter(), what)),
        };
        let correlations = [correlation(&found), correlation(&deceived)];
        let bins = edges(looks, by).into_iter().filter_map(|(low, high)| {
            let inside = |look: &&EvaluatedLook| {
                let value = by.of(look);
                value == low || (low..high).contains(&value)
            };
            let looks: Vec<_> = looks.iter().filter(inside).collect();
            let rate = |what: &dyn Fn(&EvaluatedLook) -> (bool, bool), correlation| {
                Rate::clustered(&by_day(looks.iter().copied(), what), correlation)
            };
            (!looks.is_empty()).then(|| CircumstanceBin {
                low,
                high,
                found: rate(&found, correlations[0]),
                deceived: rate(&deceived, correlations[1]),
            })
        });
        Self {
            by,
            bins: bins.collect(),
        }
    }
}

/// Counts (happened, could have happened) by day.
fn by_day<'a>(
    looks: impl Iterator<Item = &'a EvaluatedLook>,
    what: &dyn Fn(&EvaluatedLook) -> (bool, bool),
) -> Vec<(usize, usize)> {
    counts_by_day(looks.map(|look| (look.day, what(look))))
}

/// Round edges (1, 2 or 5 times a power of ten apart) around all values, or the values themselves.
fn edges(looks: &[EvaluatedLook], by: By) -> Vec<(f64, f64)> {
    let mut values: Vec<f64> = looks.iter().map(|look| by.of(look)).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    let (Some(&least), Some(&greatest)) = (values.first(), values.last()) else {
        return Vec::new();
    };
    let raw = (greatest - least) / BINS;
    if by.counts() || raw <= 1e-9 * greatest.abs().max(1.0) {
        return values.into_iter().map(|v| (v, v)).collect();
    }
    let power = 10_f64.powf(raw.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|m| m * power);
    let step = steps
        .into_iter()
        .find(|s| *s >= raw)
        .unwrap_or(10.0 * power);
    let (first, last) = (
        (least / step).floor() as i64,
        (greatest / step).floor() as i64,
    );
    let edge = |i: i64| i as f64 * step;
    (first..=last).map(|i| (edge(i), edge(i + 1))).collect()
}

#[cfg(test)]
mod tests {
    use super::super::sample::{SyntheticDetector, look, mark};
    use super::*;

    #[test]
    fn every_look_is_in_one_bin_of_round_edges() {
        let looks = SyntheticDetector::USUAL.looks(8, 50, 4);
        for by in By::ALL {
            let broken = DetectionBreakdown::of(&looks, by, 1.5);
            let counted: usize = broken.bins.iter().map(|b| b.deceived.of).sum();
            assert_eq!(counted, looks.len(), "{by:?}");
            assert!(broken.bins.len() <= 10, "{by:?}");
            assert!(broken.bins.windows(2).all(|p| p[0].high <= p[1].low));
        }
        let heights = DetectionBreakdown::of(&looks, By::Height, 1.5);
        assert_eq!((heights.bins[0].low, heights.bins[0].high), (60.0, 80.0));
    }

    #[test]
    fn what_is_never_found_from_high_up_shows() {
        let looks: Vec<_> = (0..100)
            .map(|i| {
                let mut seen = look(i % 10, &[mark(if i < 60 { 0.9 } else { 0.1 }, true)]);
                seen.height = 50.0 + i as f64;
                seen
            })
            .collect();
        let broken = DetectionBreakdown::of(&looks, By::Height, 0.5);
        let share = |i: usize| broken.bins[i].found.share().unwrap();
        assert_eq!((share(0), share(broken.bins.len() - 1)), (1.0, 0.0));
    }

    #[test]
    fn one_height_is_one_bin() {
        let looks = [look(0, &[]), look(1, &[])];
        let broken = DetectionBreakdown::of(&looks, By::Height, 0.5);
        assert_eq!(broken.bins.len(), 1);
        assert_eq!(broken.bins[0].found.of, 2);
    }
}
