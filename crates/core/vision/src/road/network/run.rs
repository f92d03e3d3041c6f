//! The network at work.

use std::rc::Rc;

use super::plan::{NETWORK_STEPS, NetworkStep, weight_count};
use super::simd::{depthwise_row, matrix_product};
use super::tensor::ChannelGrid;

/// A network with its weights.
#[derive(Clone, Debug, PartialEq)]
pub struct RoadNetwork {
    weights: Vec<f32>,
}

/// The weights that `crates/core/training/examples/train_roads.rs` made.
static BUILT_IN: &[u8] = include_bytes!("roads.weights");

impl RoadNetwork {
    /// The network that was trained on drawn and generated ground and on a satellite picture of Las Vegas (`SpaceNet`
    /// roads, CC BY-SA 4.0, imagery courtesy of Maxar).
    pub fn built_in() -> Self {
        let read = Self::from_bytes(BUILT_IN);
        read.unwrap_or_else(|| Self {
            weights: vec![0.0; weight_count()],
        })
    }

    /// A network from its weights, in the order of its steps; `None` if they are not as many as it has.
    pub fn new(weights: Vec<f32>) -> Option<Self> {
        (weights.len() == weight_count()).then_some(Self { weights })
    }

    /// A network from a file: its weights one after the other, 32 bits each, the lowest byte first.
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let (words, rest) = bytes.as_chunks::<4>();
        let finite = |word: &[u8; 4]| Some(f32::from_le_bytes(*word)).filter(|w| w.is_finite());
        let weights: Option<Vec<f32>> = words.iter().map(finite).collect();
        weights.filter(|_| rest.is_empty()).and_then(Self::new)
    }

    /// The file from which the network is made.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.weights.iter().flat_map(|w| w.to_le_bytes()).collect()
    }

    /// All weights, in the order of the steps.
    pub fn weights(&self) -> &[f32] {
        &self.weights
    }

    /// Log odds of road at half a metre per pixel, one channel, as large as the input.
    pub fn log_odds(&self, input: ChannelGrid) -> ChannelGrid {
        let mut kept: [Option<Rc<ChannelGrid>>; 2] = [None, None];
        let mut grid = Rc::new(input);
        let mut waiting = None;
        let mut left = self.weights.as_slice();
        for step in NETWORK_STEPS {
            let (weights, rest) = left.split_at(step.weights());
            left = rest;
            match step {
                // Made row by row for the matrix that comes next: it never leaves the cache.
                NetworkStep::Fold | NetworkStep::Depthwise { .. } => {
                    waiting = Some((step, weights));
                }
                NetworkStep::Matrix { outputs, cut, .. } => {
                    let out = product(&grid, waiting.take(), weights, outputs, cut);
                    grid = Rc::new(out);
                }
                NetworkStep::Unfold => grid = Rc::new(grid.unfolded()),
                NetworkStep::Keep(slot) => kept[slot] = Some(Rc::clone(&grid)),
                NetworkStep::Add(slot, cut) => {
                    if let Some(other) = kept[slot].take() {
                        Rc::make_mut(&mut grid).add(&other, cut);
                    }
                }
            }
        }
        quarters(&grid)
    }
}

/// Each pixel of a grid, or of what the step `before` with its weights makes of it, times a matrix with `outputs` columns
/// and its offsets; below zero cut if `cut`.
fn product(
    grid: &ChannelGrid,
    before: Option<(NetworkStep, &[f32])>,
    weights: &[f32],
    outputs: usize,
    cut: bool,
) -> ChannelGrid {
    let (matrix, offsets) = weights.split_at(weights.len() - outputs);
    let is_fold = matches!(before, Some((NetworkStep::Fold, _)));
    let half = if is_fold { 2 } else { 1 };
    let (width, height) = (grid.width / half, grid.height / half);
    let mut out = ChannelGrid::zeros(width, height, outputs);
    let mut made = vec![0.0; width * (matrix.len() / outputs)];
    let rows = out.values.chunks_exact_mut((width * outputs).max(1));
    for (row, out) in rows.enumerate() {
        let line = match before {
            Some((
                NetworkStep::Depthwise {
                    channels,
                    apart,
                    cut,
                },
                weights,
            )) => {
                let (taps, offsets) = weights.split_at(9 * channels);
                depthwise_row(grid, row, taps, offsets, apart, cut, &mut made);
                &made
            }
            Some(_) => {
                grid.fold_row(row, &mut made);
                &made
            }
            None => &grid.values[row * made.len()..][..made.len()],
        };
        matrix_product(line, matrix, offsets, cut, out);
    }
    out
}

/// The first four channels as the quarters of each pixel.
fn quarters(grid: &ChannelGrid) -> ChannelGrid {
    let pixels = grid.values.chunks_exact(grid.channels);
    let first = ChannelGrid {
        width: grid.width,
        height: grid.height,
        channels: 4,
        values: pixels
            .flat_map(|pixel| pixel[..4].iter().copied())
            .collect(),
    };
    first.unfolded()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_brings_back_the_network_and_a_broken_one_none() {
        let weights: Vec<f32> = (0..weight_count())
            .map(|i| (i as f32 * 0.37).sin())
            .collect();
        let network = RoadNetwork::new(weights).unwrap();
        let mut bytes = network.to_bytes();
        assert_eq!(RoadNetwork::from_bytes(&bytes), Some(network));
        assert_eq!(RoadNetwork::from_bytes(&bytes[1..]), None);
        bytes[..4].copy_from_slice(&f32::NAN.to_le_bytes());
        assert_eq!(RoadNetwork::from_bytes(&bytes), None);
    }

    #[test]
    fn the_built_in_network_is_read() {
        assert!(RoadNetwork::from_bytes(BUILT_IN).is_some());
        assert!(BUILT_IN.len() < 100_000);
    }

    #[test]
    fn with_all_weights_but_the_last_offsets_zero_the_quarters_have_these() {
        let mut weights = vec![0.0; weight_count()];
        let last = weights.len() - 8;
        weights[last..].copy_from_slice(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
        let network = RoadNetwork::new(weights).unwrap();
        let odds = network.log_odds(ChannelGrid::zeros(8, 4, 4));
        assert_eq!((odds.width, odds.height, odds.channels), (8, 4, 1));
        assert_eq!(odds.values[..4], [1.0, 2.0, 1.0, 2.0]);
        assert_eq!(odds.values[8..12], [3.0, 4.0, 3.0, 4.0]);
    }
}
