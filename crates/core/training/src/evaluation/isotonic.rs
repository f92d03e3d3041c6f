//! The rising function nearest to samples.

use serde::{Deserialize, Serialize};

/// A function that never falls: level over the samples that were pooled, straight between.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Isotonic {
    /// Places and values, both ascending.
    points: Vec<[f64; 2]>,
}

/// Neighbouring samples of one value.
struct Block {
    first: f64,
    last: f64,
    value: f64,
    weight: f64,
}

impl Isotonic {
    /// Least squares among functions that never fall, of samples (place, value, weight): neighbours that
    /// fall are pooled (Ayer et al. 1955).
    ///
    /// ```
    /// use pilotage_training::evaluation::Isotonic;
    ///
    /// // 3 before 1 falls: both become 2.
    /// let rising = Isotonic::rising(&[[0.0, 0.0, 1.0], [1.0, 3.0, 1.0], [2.0, 1.0, 1.0], [3.0, 4.0, 1.0]]);
    /// assert_eq!([0.0, 1.0, 1.5, 2.0, 3.0].map(|x| rising.at(x)), [0.0, 2.0, 2.0, 2.0, 4.0]);
    /// ```
    pub fn rising(samples: &[[f64; 3]]) -> Self {
        let mut samples = samples.to_vec();
        samples.retain(|s| s[2] > 0.0);
        samples.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut blocks: Vec<Block> = Vec::new();
        for [place, value, weight] in samples {
            match blocks.last_mut() {
                Some(last) if last.first == place => {
                    last.pool(place, value, weight);
                }
                _ => {
                    // All samples of the place before are in: it can be pooled.
                    settle(&mut blocks);
                    blocks.push(Block {
                        first: place,
                        last: place,
                        value,
                        weight,
                    });
                }
            }
        }
        settle(&mut blocks);
        let mut points = Vec::new();
        for block in blocks {
            points.push([block.first, block.value]);
            if block.last > block.first {
                points.push([block.last, block.value]);
            }
        }
        Self { points }
    }

    /// The value at a place; beyond the samples that at their end, NaN without samples.
    pub fn at(&self, place: f64) -> f64 {
        let after = self.points.partition_point(|p| p[0] < place);
        match (
            after.checked_sub(1).map(|i| self.points[i]),
            self.points.get(after),
        ) {
            (Some([x0, y0]), Some([x1, y1])) => y0 + (y1 - y0) * (place - x0) / (x1 - x0),
            (None, Some(end)) => end[1],
            (Some(end), None) => end[1],
            (None, None) => f64::NAN,
        }
    }
}

impl Block {
    fn pool(&mut self, last: f64, value: f64, weight: f64) {
        let sum = self.weight + weight;
        self.value = (self.value * self.weight + value * weight) / sum;
        self.weight = sum;
        self.last = last;
    }
}

/// Pools the last blocks until they rise.
fn settle(blocks: &mut Vec<Block>) {
    while let [.., before, last] = blocks.as_slice()
        && before.value >= last.value
    {
        if let (Some(last), Some(before)) = (blocks.pop(), blocks.last_mut()) {
            before.pool(last.last, last.value, last.weight);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_that_fall_are_pooled() {
        let samples = [1.0, 3.0, 2.0, 6.0, 5.0, 4.0, 7.0];
        let samples: Vec<_> = (0..7).map(|i| [i as f64, samples[i], 1.0]).collect();
        let fitted = Isotonic::rising(&samples);
        let values: Vec<f64> = (0..7).map(|i| fitted.at(f64::from(i))).collect();
        assert_eq!(values, [1.0, 2.5, 2.5, 5.0, 5.0, 5.0, 7.0]);
        assert_eq!(fitted.at(2.5), 3.75);
        assert_eq!((fitted.at(-4.0), fitted.at(40.0)), (1.0, 7.0));
    }

    #[test]
    fn samples_of_one_place_are_averaged_by_weight() {
        let fitted = Isotonic::rising(&[[1.0, 0.0, 3.0], [1.0, 1.0, 1.0], [2.0, 0.5, 1.0]]);
        assert_eq!((fitted.at(1.0), fitted.at(2.0)), (0.25, 0.5));
    }
}
