//! The loops of the gradient, compiled for AVX2 where there is AVX2.
#![cfg_attr(
    target_arch = "x86_64",
    expect(
        unsafe_code,
        reason = "functions for an instruction set that was looked for at run time"
    )
)]
#![expect(
    clippy::inline_always,
    reason = "loops, each compiled into the function that enables an instruction set"
)]

use pilotage_vision::road::network::ChannelGrid;

/// Channels of a block of sums.
const BLOCK: usize = 8;

#[inline(always)]
fn multiply_add<const FUSED: bool>(a: f32, b: f32, c: f32) -> f32 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// Adds the products of values (`inputs` per pixel) and slopes, summed over pixels, to a matrix with a row for each input.
pub(super) fn matrix_slopes(values: &[f32], inputs: usize, slopes: &[f32], matrix: &mut [f32]) {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
        // SAFETY: the instructions were looked for.
        return unsafe { matrix_slopes_fast(values, inputs, slopes, matrix) };
    }
    matrix_lanes::<false>(values, inputs, slopes, matrix);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn matrix_slopes_fast(values: &[f32], inputs: usize, slopes: &[f32], matrix: &mut [f32]) {
    matrix_lanes::<true>(values, inputs, slopes, matrix);
}

#[inline(always)]
fn matrix_lanes<const FUSED: bool>(
    values: &[f32],
    inputs: usize,
    slopes: &[f32],
    matrix: &mut [f32],
) {
    let outputs = matrix.len() / inputs;
    for from in (0..inputs).step_by(BLOCK) {
        for to in (0..outputs).step_by(BLOCK) {
            let mut sums = [[0.0; BLOCK]; BLOCK];
            let pixels = values
                .chunks_exact(inputs)
                .zip(slopes.chunks_exact(outputs));
            for (value, slope) in pixels {
                let value = &value[from..from + BLOCK];
                let slope = &slope[to..to + BLOCK];
                for k in 0..BLOCK {
                    for j in 0..BLOCK {
                        sums[k][j] = multiply_add::<FUSED>(value[k], slope[j], sums[k][j]);
                    }
                }
            }
            for (k, sums) in sums.iter().enumerate() {
                let row = &mut matrix[(from + k) * outputs + to..][..BLOCK];
                for (total, sum) in row.iter_mut().zip(sums) {
                    *total += sum;
                }
            }
        }
    }
}

/// Adds the products of values and slopes, summed over pixels, to nine taps `apart` pixels apart and to the offsets
/// behind them; 16 or 32 channels.
pub(super) fn tap_slopes(
    before: &ChannelGrid,
    slope: &ChannelGrid,
    apart: usize,
    place: &mut [f32],
) {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
        // SAFETY: the instructions were looked for.
        return unsafe { tap_slopes_fast(before, slope, apart, place) };
    }
    tap_lanes::<false>(before, slope, apart, place);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn tap_slopes_fast(before: &ChannelGrid, slope: &ChannelGrid, apart: usize, place: &mut [f32]) {
    tap_lanes::<true>(before, slope, apart, place);
}

#[inline(always)]
fn tap_lanes<const FUSED: bool>(
    before: &ChannelGrid,
    slope: &ChannelGrid,
    apart: usize,
    place: &mut [f32],
) {
    match before.channels {
        16 => taps_of::<16, FUSED>(before, slope, apart, place),
        32 => taps_of::<32, FUSED>(before, slope, apart, place),
        other => panic!("{other} channels are neither 16 nor 32"),
    }
}

#[inline(always)]
fn taps_of<const CHANNELS: usize, const FUSED: bool>(
    before: &ChannelGrid,
    slope: &ChannelGrid,
    apart: usize,
    place: &mut [f32],
) {
    let (width, height) = (before.width, before.height);
    let values = before.values.as_chunks::<CHANNELS>().0;
    let slopes = slope.values.as_chunks::<CHANNELS>().0;
    let sums = place.as_chunks_mut::<CHANNELS>().0;
    for y in 0..height {
        let line = &slopes[y * width..][..width];
        for (tap, total) in sums.iter_mut().take(9).enumerate() {
            let row = (y + tap / 3 * apart).checked_sub(apart);
            let Some(row) = row.filter(|r| *r < height) else {
                continue;
            };
            let source = &values[row * width..][..width];
            let shift = tap % 3 * apart;
            let (to, from) = (apart.saturating_sub(shift), shift.saturating_sub(apart));
            let count = width.saturating_sub(to.max(from));
            let mut sum = [0.0; CHANNELS];
            if count > 0 {
                let pairs = line[to..to + count].iter().zip(&source[from..from + count]);
                for (slope, value) in pairs {
                    for c in 0..CHANNELS {
                        sum[c] = multiply_add::<FUSED>(slope[c], value[c], sum[c]);
                    }
                }
            }
            for c in 0..CHANNELS {
                total[c] += sum[c];
            }
        }
        for slope in line {
            for c in 0..CHANNELS {
                sums[9][c] += slope[c];
            }
        }
    }
}
