//! Judgement of classes where they were not learned.

use std::fmt;

use super::LabelledTile;
use pilotage_vision::ground_class::{CoverFeatures, CoverNetwork, GroundCover};

const CLASSES: usize = GroundCover::ALL.len();
/// Ranges of the probability of the likeliest class.
const RANGES: usize = 10;

/// Counts of told classes against true ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CoverJudgement {
    /// Cells by true class, then by told class.
    pub confusion: [[u64; CLASSES]; CLASSES],
    /// Cells by range of the told probability: their number, how many are right, and the sum of the probabilities.
    pub calibration: [(u64, u64, f64); RANGES],
}

impl CoverJudgement {
    /// Tells every cell of a tile, and counts.
    pub fn add(&mut self, tile: &LabelledTile, network: &CoverNetwork) {
        let features = CoverFeatures::of(&tile.picture);
        for (at, cover) in tile.covers.iter().enumerate() {
            let Some(cover) = cover.filter(|_| features.seen()[at]) else {
                continue;
            };
            let cell = features.cell(at % features.width(), at / features.width());
            let told = network.probabilities(&cell);
            let likeliest = (0..CLASSES).max_by(|a, b| told[*a].total_cmp(&told[*b]));
            let likeliest = likeliest.unwrap_or_default();
            self.confusion[cover.index()][likeliest] += 1;
            let probability = f64::from(told[likeliest]);
            let range = ((probability * RANGES as f64) as usize).min(RANGES - 1);
            let (count, right, sum) = &mut self.calibration[range];
            *count += 1;
            *right += u64::from(likeliest == cover.index());
            *sum += probability;
        }
    }

    /// Share of the cells of each true class that are told right.
    pub fn recalls(&self) -> [f64; CLASSES] {
        std::array::from_fn(|class| {
            let all: u64 = self.confusion[class].iter().sum();
            self.confusion[class][class] as f64 / all.max(1) as f64
        })
    }

    /// Share of all cells that are told right.
    pub fn accuracy(&self) -> f64 {
        let right: u64 = (0..CLASSES).map(|class| self.confusion[class][class]).sum();
        right as f64 / self.cells().max(1) as f64
    }

    /// Expected calibration error: mean distance of probability and share of right ones, over the ranges.
    pub fn calibration_error(&self) -> f64 {
        let distances = self.calibration.iter();
        let sum: f64 = distances
            .map(|(_, right, sum)| (sum - *right as f64).abs())
            .sum();
        sum / self.cells().max(1) as f64
    }

    fn cells(&self) -> u64 {
        self.confusion.as_flattened().iter().sum()
    }
}

impl fmt::Display for CoverJudgement {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "{:>10}", "true/told")?;
        for cover in GroundCover::ALL {
            write!(to, "{:>10}", cover.key())?;
        }
        writeln!(to, "{:>10}", "cells")?;
        for cover in GroundCover::ALL {
            let row = &self.confusion[cover.index()];
            let all: u64 = row.iter().sum();
            write!(to, "{:>10}", cover.key())?;
            for count in row {
                write!(to, "{:>10.4}", *count as f64 / all.max(1) as f64)?;
            }
            writeln!(to, "{all:>10}")?;
        }
        let mean = self.recalls().iter().sum::<f64>() / CLASSES as f64;
        let (right, error) = (self.accuracy(), self.calibration_error());
        writeln!(
            to,
            "right {right:.4} of {} cells, mean of the diagonal {mean:.4}, calibration error {error:.4}",
            self.cells()
        )
    }
}
