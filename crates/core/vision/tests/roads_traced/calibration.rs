//! Calibration of the probability of roads, and what a temperature learned at other places makes of it.

use super::sites::Site;
use pilotage_raster::raster::Gray;

/// Ranges of probabilities.
const RANGES: usize = 100;

/// Pixels by the probability that was told, and those on roads.
#[derive(Clone)]
pub struct RoadCounts {
    counts: [[f64; 2]; RANGES],
}

/// Change of log odds: over a temperature, and an offset added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogOddsChange {
    pub temperature: f64,
    pub offset: f64,
}

impl LogOddsChange {
    pub const NONE: Self = Self {
        temperature: 1.0,
        offset: 0.0,
    };

    fn of(self, probability: f64) -> f64 {
        let odds = (probability / (1.0 - probability)).ln();
        1.0 / (1.0 + (-odds / self.temperature - self.offset).exp())
    }
}

impl RoadCounts {
    /// Counts of a place, its unsure ground left out.
    pub fn of(site: &Site, probability: &Gray) -> Option<Self> {
        let truth = site.road_mask()?;
        let mut counts = [[0.0; 2]; RANGES];
        for y in 0..truth.height() {
            for x in 0..truth.width() {
                if site.is_sure([x as f64 + 0.5, y as f64 + 0.5]) {
                    let range = (probability.get(x, y) * RANGES as f32) as usize;
                    let own = &mut counts[range.min(RANGES - 1)];
                    own[0] += 1.0;
                    own[1] += f64::from(u8::from(truth.get(x, y)));
                }
            }
        }
        Some(Self { counts })
    }

    /// Counts of several places, each with the same weight.
    pub fn joined<'a>(all: impl Iterator<Item = &'a Self>) -> Self {
        let mut counts = [[0.0; 2]; RANGES];
        for one in all {
            let share = 1.0 / one.pixels();
            for (sum, own) in counts.iter_mut().zip(&one.counts) {
                *sum = [sum[0] + share * own[0], sum[1] + share * own[1]];
            }
        }
        Self { counts }
    }

    fn pixels(&self) -> f64 {
        self.counts.iter().map(|[count, _]| count).sum()
    }

    /// Probability in the middle of each range, its pixels and those on roads.
    fn ranges(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let numbered = self.counts.iter().enumerate();
        numbered.map(|(i, [count, road])| ((i as f64 + 0.5) / RANGES as f64, *count, *road))
    }

    /// Pixels of a probability of nine tenths or more, and those of them on roads.
    pub fn surest(&self) -> [f64; 2] {
        let sure = self.ranges().filter(|(probability, ..)| *probability > 0.9);
        sure.fold([0.0; 2], |[all, on], (_, count, road)| {
            [all + count, on + road]
        })
    }

    /// Mean distance of the probability from the share of road, over ten ranges of what is told after the change.
    pub fn calibration_error(&self, change: LogOddsChange) -> f64 {
        let mut told = [[0.0; 2]; 10];
        for (probability, count, road) in self.ranges() {
            let changed = change.of(probability);
            let own = &mut told[((10.0 * changed) as usize).min(9)];
            *own = [own[0] + count * changed, own[1] + road];
        }
        told.iter()
            .map(|[said, road]| (said - road).abs())
            .sum::<f64>()
            / self.pixels()
    }

    /// Mean logarithm of the likelihood.
    fn log_likelihood(&self, change: LogOddsChange) -> f64 {
        let each = self.ranges().map(|(probability, count, road)| {
            let changed = change.of(probability);
            road * changed.ln() + (count - road) * (1.0 - changed).ln()
        });
        each.sum::<f64>() / self.pixels()
    }

    /// The likeliest change with one of these offsets.
    pub fn fitted(&self, offsets: &[f64]) -> LogOddsChange {
        let tried = (0..40).flat_map(|step| {
            let temperature = 1.1_f64.powi(step - 8);
            offsets.iter().map(move |offset| LogOddsChange {
                temperature,
                offset: *offset,
            })
        });
        let likelihood = |change: &LogOddsChange| self.log_likelihood(*change);
        tried
            .max_by(|a, b| likelihood(a).total_cmp(&likelihood(b)))
            .unwrap_or(LogOddsChange::NONE)
    }
}
