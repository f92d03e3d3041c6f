//! The steps of the network, one after the other.

/// A step of the network. Weights lie in the order of the steps, each step's matrix or taps before its offsets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NetworkStep {
    /// Squares of two by two pixels become one pixel of four times the channels: those of the top left first, then
    /// top right, bottom left, bottom right.
    Fold,
    /// The reverse of [`Fold`](Self::Fold).
    Unfold,
    /// Each pixel times a matrix (a row of `outputs` for each input), plus offsets; below zero cut if `cut`.
    Matrix {
        /// Channels before.
        inputs: usize,
        /// Channels after, a multiple of 8.
        outputs: usize,
        /// Whether values below zero become zero.
        cut: bool,
    },
    /// Each channel's correlation with nine taps (three rows from the top, channels side by side), `apart` pixels
    /// apart, zero beyond the picture, plus offsets.
    Depthwise {
        /// Channels, 16 or 32.
        channels: usize,
        /// Pixels between neighbouring taps.
        apart: usize,
        /// Whether values below zero become zero.
        cut: bool,
    },
    /// Keeps what there is, to be added later.
    Keep(usize),
    /// Adds what was kept; below zero cut if the second says so.
    Add(usize, bool),
}

use NetworkStep::{Add, Depthwise, Fold, Keep, Matrix, Unfold};

const fn matrix(inputs: usize, outputs: usize, cut: bool) -> NetworkStep {
    Matrix {
        inputs,
        outputs,
        cut,
    }
}

const fn depthwise(channels: usize, apart: usize, cut: bool) -> NetworkStep {
    Depthwise {
        channels,
        apart,
        cut,
    }
}

/// All steps, from four channels at 0.5 m per pixel to eight at 1 m, of which the first four are the log odds of road
/// in its four quarters.
pub const NETWORK_STEPS: [NetworkStep; 41] = [
    Fold,
    matrix(16, 16, true),
    depthwise(16, 1, false),
    matrix(16, 16, true),
    Keep(0),
    Fold,
    matrix(64, 32, true),
    Keep(1),
    depthwise(32, 1, true),
    matrix(32, 32, false),
    Add(1, false),
    Keep(1),
    depthwise(32, 2, true),
    matrix(32, 32, false),
    Add(1, false),
    Keep(1),
    depthwise(32, 4, true),
    matrix(32, 32, false),
    Add(1, false),
    Keep(1),
    depthwise(32, 8, true),
    matrix(32, 32, false),
    Add(1, false),
    Keep(1),
    depthwise(32, 4, true),
    matrix(32, 32, false),
    Add(1, false),
    Keep(1),
    depthwise(32, 2, true),
    matrix(32, 32, false),
    Add(1, false),
    Keep(1),
    depthwise(32, 1, true),
    matrix(32, 32, false),
    Add(1, true),
    matrix(32, 64, false),
    Unfold,
    Add(0, true),
    depthwise(16, 1, false),
    matrix(16, 16, true),
    matrix(16, 8, false),
];

impl NetworkStep {
    /// Weights of the step, offsets among them.
    pub fn weights(self) -> usize {
        match self {
            Matrix {
                inputs, outputs, ..
            } => (inputs + 1) * outputs,
            Depthwise { channels, .. } => 10 * channels,
            _ => 0,
        }
    }
}

/// Weights of all steps.
pub fn weight_count() -> usize {
    NETWORK_STEPS.iter().map(|step| step.weights()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The network at work makes them row by row for that matrix.
    #[test]
    fn a_matrix_follows_each_fold_and_each_correlation() {
        for (index, step) in NETWORK_STEPS.iter().enumerate() {
            if matches!(step, Fold | Depthwise { .. }) {
                let next = NETWORK_STEPS.get(index + 1);
                assert!(matches!(next, Some(Matrix { .. })), "step {index}");
            }
        }
    }
}
