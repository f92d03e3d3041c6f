//! Counts of three told classes: building, field, tree.

use std::fmt;

use pilotage_vision::ground_class::GroundCover;

/// The three classes of the thesis.
pub const THREE: [GroundCover; 3] = [GroundCover::Building, GroundCover::Open, GroundCover::Tree];
const RANGES: usize = 10;

/// Told classes by true class, and how true the probabilities were.
#[derive(Clone, Default)]
pub struct ThreeClasses {
    confusion: [[usize; 3]; 3],
    ranges: [(usize, usize, f64); RANGES],
}

impl ThreeClasses {
    /// Counts a point of class `cover` that was told with `odds` of the three, of any sum.
    pub fn add(&mut self, cover: GroundCover, odds: [f64; 3]) {
        let Some(truth) = THREE.iter().position(|class| *class == cover) else {
            return;
        };
        let told = (0..3).max_by(|a, b| odds[*a].total_cmp(&odds[*b])).unwrap();
        self.confusion[truth][told] += 1;
        let probability = odds[told] / odds.iter().sum::<f64>().max(1e-12);
        let range = ((probability * RANGES as f64) as usize).min(RANGES - 1);
        let (count, right, sum) = &mut self.ranges[range];
        *count += 1;
        *right += usize::from(told == truth);
        *sum += probability;
    }

    /// Adds what another counted.
    pub fn join(&mut self, other: &Self) {
        for (own, other) in self
            .confusion
            .as_flattened_mut()
            .iter_mut()
            .zip(other.confusion.as_flattened())
        {
            *own += other;
        }
        for (own, other) in self.ranges.iter_mut().zip(&other.ranges) {
            *own = (own.0 + other.0, own.1 + other.1, own.2 + other.2);
        }
    }

    /// Points counted.
    pub fn points(&self) -> usize {
        self.confusion.as_flattened().iter().sum()
    }

    /// Share that was told right.
    pub fn right(&self) -> f64 {
        let right: usize = (0..3).map(|class| self.confusion[class][class]).sum();
        right as f64 / self.points().max(1) as f64
    }

    /// Mean share told right of the classes that occur.
    pub fn diagonal(&self) -> f64 {
        let rows = self.confusion.iter().enumerate();
        let shares = rows.filter_map(|(class, row)| {
            let all: usize = row.iter().sum();
            (all > 0).then(|| row[class] as f64 / all as f64)
        });
        let shares: Vec<f64> = shares.collect();
        shares.iter().sum::<f64>() / shares.len().max(1) as f64
    }

    /// Expected calibration error.
    pub fn calibration_error(&self) -> f64 {
        let apart = self
            .ranges
            .iter()
            .map(|(_, right, sum)| (sum - *right as f64).abs());
        apart.sum::<f64>() / self.points().max(1) as f64
    }
}

impl fmt::Display for ThreeClasses {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            to,
            "building {:?}, field {:?}, tree {:?}: right {:.3} of {}, diagonal {:.3}, calibration error {:.3}",
            self.confusion[0],
            self.confusion[1],
            self.confusion[2],
            self.right(),
            self.points(),
            self.diagonal(),
            self.calibration_error()
        )
    }
}
