//! The loss of the network on a picture, and its gradient by the weights.

use pilotage_vision::road::network::{
    ChannelGrid, NETWORK_STEPS, NetworkStep, RoadNetwork, depthwise, matrix_product, network_input,
};

use super::example::{RoadExample, RoadTruth};
use super::simd::{matrix_slopes, tap_slopes};

/// Pixels of which products are summed at a time.
const CHUNK: usize = 512;

/// Loss and its gradient.
#[derive(Clone, Debug, PartialEq)]
pub struct LossGradient {
    /// Mean of -ln(probability of the truth) over the pixels of known truth.
    pub loss: f64,
    /// Derivative by each weight.
    pub weights: Vec<f32>,
}

/// Loss and gradient of a network on a picture.
pub fn loss_gradient(network: &RoadNetwork, example: &RoadExample) -> LossGradient {
    let (outputs, input) = forward(network, network_input(&example.picture));
    let (loss, last) = loss(&outputs[outputs.len() - 1], example);
    let weights = backward(network, &input, &outputs, last);
    LossGradient { loss, weights }
}

/// The results of all steps, and the input.
fn forward(network: &RoadNetwork, input: ChannelGrid) -> (Vec<ChannelGrid>, ChannelGrid) {
    let mut outputs: Vec<ChannelGrid> = Vec::with_capacity(NETWORK_STEPS.len());
    let mut kept = [0; 2];
    let mut left = network.weights();
    for (i, step) in NETWORK_STEPS.into_iter().enumerate() {
        let (weights, rest) = left.split_at(step.weights());
        left = rest;
        let grid = if i == 0 { &input } else { &outputs[i - 1] };
        let out = match step {
            NetworkStep::Fold => grid.folded(),
            NetworkStep::Unfold => grid.unfolded(),
            NetworkStep::Matrix {
                inputs,
                outputs,
                cut,
            } => {
                let (matrix, offsets) = weights.split_at(inputs * outputs);
                let mut out = ChannelGrid::zeros(grid.width, grid.height, outputs);
                matrix_product(&grid.values, matrix, offsets, cut, &mut out.values);
                out
            }
            NetworkStep::Depthwise {
                channels,
                apart,
                cut,
            } => {
                let (taps, offsets) = weights.split_at(9 * channels);
                depthwise(grid, taps, offsets, apart, cut)
            }
            NetworkStep::Keep(slot) => {
                kept[slot] = i;
                grid.clone()
            }
            NetworkStep::Add(slot, cut) => {
                let mut sum = grid.clone();
                sum.add(&outputs[kept[slot]], cut);
                sum
            }
        };
        outputs.push(out);
    }
    (outputs, input)
}

/// Mean loss over the quarters of the last step's pixels, and its derivative by that step's values.
fn loss(last: &ChannelGrid, example: &RoadExample) -> (f64, ChannelGrid) {
    let mut slope = ChannelGrid::zeros(last.width, last.height, last.channels);
    let known = example
        .truth
        .pixels()
        .iter()
        .filter(|t| **t != RoadTruth::Unknown);
    let scale = 1.0 / known.count().max(1) as f32;
    let mut sum = 0.0;
    for y in 0..example.truth.height() {
        for (x, truth) in example.truth.row(y).iter().enumerate() {
            let target = match truth {
                RoadTruth::Open => 0.0,
                RoadTruth::Road => 1.0,
                RoadTruth::Unknown => continue,
            };
            let at = (y / 2 * last.width + x / 2) * last.channels + y % 2 * 2 + x % 2;
            let odds = last.values[at];
            // ln(1 + exp(z)) - t z, without overflow.
            sum += f64::from(odds.max(0.0) - target * odds + (-odds.abs()).exp().ln_1p());
            slope.values[at] = scale * (1.0 / (1.0 + (-odds).exp()) - target);
        }
    }
    (sum * f64::from(scale), slope)
}

/// Derivatives by the weights, from the derivative by the last step's values.
fn backward(
    network: &RoadNetwork,
    input: &ChannelGrid,
    outputs: &[ChannelGrid],
    last: ChannelGrid,
) -> Vec<f32> {
    let mut gradient = vec![0.0; network.weights().len()];
    let mut end = gradient.len();
    let mut slope = last;
    let mut kept: [Option<ChannelGrid>; 2] = [None, None];
    for (i, step) in NETWORK_STEPS.into_iter().enumerate().rev() {
        let before = if i == 0 { input } else { &outputs[i - 1] };
        let start = end - step.weights();
        let (weights, place) = (&network.weights()[start..end], &mut gradient[start..end]);
        end = start;
        match step {
            NetworkStep::Fold => slope = slope.unfolded(),
            NetworkStep::Unfold => slope = slope.folded(),
            NetworkStep::Matrix {
                inputs,
                outputs: count,
                cut,
            } => {
                if cut {
                    cut_where(&outputs[i], &mut slope);
                }
                by_matrix(before, &slope, place, inputs * count);
                if i > 1 {
                    let matrix = transposed(&weights[..inputs * count], count);
                    let mut out = ChannelGrid::zeros(slope.width, slope.height, inputs);
                    let none = vec![0.0; inputs];
                    matrix_product(&slope.values, &matrix, &none, false, &mut out.values);
                    slope = out;
                }
            }
            NetworkStep::Depthwise {
                channels,
                apart,
                cut,
            } => {
                if cut {
                    cut_where(&outputs[i], &mut slope);
                }
                tap_slopes(before, &slope, apart, place);
                // Correlation's reverse has its taps turned by half a turn.
                let taps = weights[..9 * channels].chunks_exact(channels).rev();
                let taps: Vec<f32> = taps.flatten().copied().collect();
                slope = depthwise(&slope, &taps, &vec![0.0; channels], apart, false);
            }
            NetworkStep::Keep(slot) => {
                if let Some(other) = kept[slot].take() {
                    slope.add(&other, false);
                }
            }
            NetworkStep::Add(slot, cut) => {
                if cut {
                    cut_where(&outputs[i], &mut slope);
                }
                kept[slot] = Some(slope.clone());
            }
        }
    }
    gradient
}

/// No slope where the value was cut at zero.
fn cut_where(values: &ChannelGrid, slope: &mut ChannelGrid) {
    for (slope, value) in slope.values.iter_mut().zip(&values.values) {
        if *value <= 0.0 {
            *slope = 0.0;
        }
    }
}

/// Rows of `columns` values as columns.
fn transposed(rows: &[f32], columns: usize) -> Vec<f32> {
    let count = rows.len() / columns;
    let mut out = vec![0.0; rows.len()];
    for (i, row) in rows.chunks_exact(columns).enumerate() {
        for (j, value) in row.iter().enumerate() {
            out[j * count + i] = *value;
        }
    }
    out
}

/// Derivatives by a matrix and its offsets.
fn by_matrix(before: &ChannelGrid, slope: &ChannelGrid, place: &mut [f32], size: usize) {
    let (inputs, count) = (before.channels, slope.channels);
    let (matrix, offsets) = place.split_at_mut(size);
    let chunks = before.values.chunks(CHUNK * inputs);
    for (values, slopes) in chunks.zip(slope.values.chunks(CHUNK * count)) {
        matrix_slopes(values, inputs, slopes, matrix);
        for pixel in slopes.chunks_exact(count) {
            for (total, value) in offsets.iter_mut().zip(pixel) {
                *total += value;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::first_weights;
    use super::*;
    use pilotage_raster::raster::Raster;

    fn example() -> RoadExample {
        RoadExample {
            picture: Raster::from_fn(24, 16, |x, y| {
                let value = (x * 31 + y * 17 + x * y * 7) % 200;
                [value as u8, (value / 2) as u8, 90, 255]
            }),
            truth: Raster::from_fn(24, 16, |x, y| match (x + y) % 5 {
                0 => RoadTruth::Road,
                1 => RoadTruth::Unknown,
                _ => RoadTruth::Open,
            }),
        }
    }

    #[test]
    fn the_loss_is_that_of_the_network_at_work() {
        let network = RoadNetwork::new(first_weights(4)).unwrap();
        let example = example();
        let odds = network.log_odds(network_input(&example.picture));
        let (mut sum, mut count) = (0.0, 0.0);
        for (odds, truth) in odds.values.iter().zip(example.truth.pixels()) {
            let probability = 1.0 / (1.0 + (-f64::from(*odds)).exp());
            match truth {
                RoadTruth::Road => sum -= probability.ln(),
                RoadTruth::Open => sum -= (1.0 - probability).ln(),
                RoadTruth::Unknown => continue,
            }
            count += 1.0;
        }
        let loss = loss_gradient(&network, &example).loss;
        assert!((loss - sum / count).abs() < 1e-5, "{loss} {}", sum / count);
    }

    #[test]
    fn the_gradient_is_the_quotient_of_small_differences() {
        // All values far from where they are cut: differences see no kink.
        let mut weights = first_weights(4);
        let mut at = 0;
        for step in NETWORK_STEPS {
            let count = step.weights();
            let offsets = match step {
                NetworkStep::Matrix { outputs, .. } => outputs,
                NetworkStep::Depthwise { channels, .. } => channels,
                _ => 0,
            };
            for weight in &mut weights[at..at + count - offsets] {
                *weight *= 0.3;
            }
            for offset in &mut weights[at + count - offsets..at + count] {
                *offset = 1.5;
            }
            at += count;
        }
        let example = example();
        let network = RoadNetwork::new(weights.clone()).unwrap();
        let gradient = loss_gradient(&network, &example).weights;
        let mut worst = 0.0_f64;
        for index in (0..weights.len()).step_by(211) {
            let loss = |change: f32| {
                let mut weights = weights.clone();
                weights[index] += change;
                loss_gradient(&RoadNetwork::new(weights).unwrap(), &example).loss
            };
            let slope = (loss(0.01) - loss(-0.01)) / 0.02;
            let off = (slope - f64::from(gradient[index])).abs() / (slope.abs() + 0.002);
            worst = worst.max(off);
        }
        assert!(worst < 0.1, "{worst}");
    }
}
