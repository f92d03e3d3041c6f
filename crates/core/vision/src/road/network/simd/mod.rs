//! The loops of the network, written for AVX2 where there is AVX2, with plain twins.
//!
//! With AVX2 a product and a sum are rounded once, elsewhere twice: results differ by rounding.
#![cfg_attr(
    target_arch = "x86_64",
    expect(
        unsafe_code,
        reason = "functions for an instruction set that was looked for at run time"
    )
)]

mod plain;
#[cfg(target_arch = "x86_64")]
mod x86;

use super::tensor::ChannelGrid;

/// The least value that stays.
fn least(cut: bool) -> f32 {
    if cut { 0.0 } else { f32::NEG_INFINITY }
}

/// Every pixel of some channels times a matrix (a row for each, as many columns as there are `offsets`) plus the
/// offsets, into `out`; below zero cut if `cut`. Outputs are a multiple of 8.
///
/// # Panics
/// If the lengths do not fit.
pub fn matrix_product(input: &[f32], matrix: &[f32], offsets: &[f32], cut: bool, out: &mut [f32]) {
    let outputs = offsets.len();
    let inputs = matrix.len() / outputs;
    let pixels = out.len() / outputs;
    assert!(
        outputs.is_multiple_of(8)
            && matrix.len() == inputs * outputs
            && input.len() == pixels * inputs
            && out.len() == pixels * outputs
    );
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
        // SAFETY: the instructions were looked for, the lengths are asserted.
        return unsafe { x86::matrix_product(input, matrix, offsets, least(cut), out) };
    }
    plain::matrix_product(input, matrix, offsets, least(cut), out);
}

/// Correlation of each channel (a multiple of 8 of them) with nine taps, `apart` pixels apart, zero beyond the picture,
/// plus offsets; below zero cut if `cut`. `taps` has three rows from the top, the channels of a tap side by side.
///
/// # Panics
/// If the lengths do not fit.
pub fn depthwise(
    input: &ChannelGrid,
    taps: &[f32],
    offsets: &[f32],
    apart: usize,
    cut: bool,
) -> ChannelGrid {
    let mut out = ChannelGrid::zeros(input.width, input.height, input.channels);
    let rows = out
        .values
        .chunks_exact_mut((input.width * input.channels).max(1));
    for (row, line) in rows.enumerate() {
        depthwise_row(input, row, taps, offsets, apart, cut, line);
    }
    out
}

/// A row of what [`depthwise`] gives.
pub(super) fn depthwise_row(
    input: &ChannelGrid,
    row: usize,
    taps: &[f32],
    offsets: &[f32],
    apart: usize,
    cut: bool,
    line: &mut [f32],
) {
    let channels = input.channels;
    assert!(
        channels.is_multiple_of(8)
            && taps.len() == 9 * channels
            && offsets.len() == channels
            && line.len() == input.width * channels
            && input.values.len() == input.height * line.len()
    );
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
        // SAFETY: the instructions were looked for, the lengths are asserted.
        return unsafe { x86::depthwise_row(input, row, taps, offsets, apart, least(cut), line) };
    }
    plain::depthwise_row(input, row, taps, offsets, apart, least(cut), line);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(count: usize, mut state: u32) -> Vec<f32> {
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 16_777_216.0 - 0.5
        };
        (0..count).map(|_| next()).collect()
    }

    #[test]
    fn a_product_is_the_sum_of_its_products() {
        let (pixels, inputs, outputs) = (21, 24, 16);
        let input = numbers(pixels * inputs, 1);
        let matrix = numbers(inputs * outputs, 2);
        let offsets = numbers(outputs, 3);
        for cut in [false, true] {
            let mut best = vec![0.0; pixels * outputs];
            matrix_product(&input, &matrix, &offsets, cut, &mut best);
            let mut slow = best.clone();
            plain::matrix_product(
                &input,
                &matrix,
                &offsets,
                if cut { 0.0 } else { f32::NEG_INFINITY },
                &mut slow,
            );
            for p in 0..pixels {
                for j in 0..outputs {
                    let products = (0..inputs).map(|k| {
                        f64::from(input[p * inputs + k]) * f64::from(matrix[k * outputs + j])
                    });
                    let sum = f64::from(offsets[j]) + products.sum::<f64>();
                    let sum = if cut { sum.max(0.0) } else { sum };
                    for value in [best[p * outputs + j], slow[p * outputs + j]] {
                        assert!((f64::from(value) - sum).abs() < 1e-5, "{value} {sum}");
                    }
                }
            }
        }
    }

    #[test]
    fn taps_reach_as_far_apart_as_they_are_said_to_be() {
        for (channels, apart) in [(16, 1), (32, 4)] {
            let mut input = ChannelGrid::zeros(13, 6, channels);
            input.values = numbers(13 * 6 * channels, 4);
            let (taps, offsets) = (numbers(9 * channels, 5), numbers(channels, 6));
            let best = depthwise(&input, &taps, &offsets, apart, false);
            let mut slow = ChannelGrid::zeros(13, 6, channels);
            for (row, line) in slow.values.chunks_exact_mut(13 * channels).enumerate() {
                plain::depthwise_row(&input, row, &taps, &offsets, apart, f32::NEG_INFINITY, line);
            }
            for (y, x, c) in [(0, 0, 3), (2, 5, 0), (5, 12, 15), (3, 11, 9), (1, 1, 7)] {
                let mut sum = f64::from(offsets[c]);
                for tap in 0..9 {
                    let row = y as isize + (tap / 3 - 1) * apart as isize;
                    let column = x as isize + (tap % 3 - 1) * apart as isize;
                    if (0..6).contains(&row) && (0..13).contains(&column) {
                        let at = (row as usize * 13 + column as usize) * channels + c;
                        sum += f64::from(input.values[at])
                            * f64::from(taps[tap as usize * channels + c]);
                    }
                }
                for grid in [&best, &slow] {
                    let value = grid.values[(y * 13 + x) * channels + c];
                    assert!(
                        (f64::from(value) - sum).abs() < 1e-5,
                        "{x} {y} {c}: {value} {sum}"
                    );
                }
            }
        }
    }
}
