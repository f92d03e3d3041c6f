//! A network of one hidden layer that tells the class of a cell by its features.

use super::{FEATURES, GroundCover};

/// Units of the hidden layer.
pub const HIDDEN: usize = 24;
/// Classes.
const CLASSES: usize = GroundCover::ALL.len();
/// Cells that are told at once.
pub(super) const TOGETHER: usize = 8;
/// Weights, those of all layers.
const WEIGHTS: usize = HIDDEN * (FEATURES + 1) + CLASSES * (HIDDEN + 1);

/// Weights of the network; each unit has those of its inputs, and its bias at the end.
#[derive(Clone, Debug, PartialEq)]
pub struct CoverNetwork {
    /// Hidden units, rectified.
    pub hidden: [[f32; FEATURES + 1]; HIDDEN],
    /// Classes: probabilities are the softmax of these.
    pub output: [[f32; HIDDEN + 1]; CLASSES],
}

/// Refusal of bytes that are no weights.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{length} bytes are no weights of the classes of the ground, which are {expected}; train them again"
)]
pub struct CoverNetworkError {
    /// Bytes that there are.
    pub length: usize,
    /// Bytes that there should be.
    pub expected: usize,
}

impl CoverNetwork {
    /// The network that tells classes apart on the days of the generated country.
    pub fn usual() -> Self {
        let stored = include_bytes!("weights.bin");
        Self::from_bytes(stored).unwrap_or(Self {
            hidden: [[0.0; FEATURES + 1]; HIDDEN],
            output: [[0.0; HIDDEN + 1]; CLASSES],
        })
    }

    /// Weights as bytes: single precision, little end first, layer by layer.
    pub fn to_bytes(&self) -> Vec<u8> {
        let hidden = self.hidden.as_flattened().iter();
        let all = hidden.chain(self.output.as_flattened());
        all.flat_map(|weight| weight.to_le_bytes()).collect()
    }

    /// The network of such bytes.
    ///
    /// # Errors
    /// There are more or fewer of them.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, CoverNetworkError> {
        if bytes.len() != 4 * WEIGHTS {
            return Err(CoverNetworkError {
                length: bytes.len(),
                expected: 4 * WEIGHTS,
            });
        }
        let (all, _) = bytes.as_chunks::<4>();
        let mut all = all.iter().map(|four| f32::from_le_bytes(*four));
        let mut next = || all.next().unwrap_or(0.0);
        let hidden = std::array::from_fn(|_| std::array::from_fn(|_| next()));
        let output = std::array::from_fn(|_| std::array::from_fn(|_| next()));
        Ok(Self { hidden, output })
    }

    /// Probabilities of the classes of a cell.
    pub fn probabilities(&self, features: &[f32; FEATURES]) -> [f32; CLASSES] {
        let spread = std::array::from_fn(|f| [features[f]; TOGETHER]);
        self.several(&spread)[0]
    }

    /// Probabilities of several cells, feature by feature.
    pub(super) fn several(
        &self,
        features: &[[f32; TOGETHER]; FEATURES],
    ) -> [[f32; CLASSES]; TOGETHER] {
        let mut hidden = [[0.0_f32; TOGETHER]; HIDDEN];
        for (unit, weights) in hidden.iter_mut().zip(&self.hidden) {
            let mut sum = [weights[FEATURES]; TOGETHER];
            for (feature, weight) in features.iter().zip(weights) {
                for (sum, value) in sum.iter_mut().zip(feature) {
                    *sum += weight * value;
                }
            }
            *unit = sum.map(|value| value.max(0.0));
        }
        let mut told = [[0.0; CLASSES]; TOGETHER];
        for (class, weights) in self.output.iter().enumerate() {
            let mut sum = [weights[HIDDEN]; TOGETHER];
            for (unit, weight) in hidden.iter().zip(weights) {
                for (sum, value) in sum.iter_mut().zip(unit) {
                    *sum += weight * value;
                }
            }
            for (cell, sum) in told.iter_mut().zip(sum) {
                cell[class] = sum;
            }
        }
        told.map(softmax)
    }
}

/// Exponentials of `scores`, scaled to a sum of one.
fn softmax(scores: [f32; CLASSES]) -> [f32; CLASSES] {
    let most = scores.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let grown = scores.map(|score| (score - most).exp());
    let sum: f32 = grown.iter().sum();
    grown.map(|value| value / sum)
}
