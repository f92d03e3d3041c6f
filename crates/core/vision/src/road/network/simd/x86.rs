//! AVX2 with fused multiply-add: sums of a block stay in registers.
#![expect(
    unsafe_code,
    reason = "vector loads and stores take pointers; the lengths are asserted by the caller"
)]

use std::arch::x86_64::{
    __m256, _mm256_fmadd_ps, _mm256_loadu_ps, _mm256_max_ps, _mm256_set1_ps, _mm256_storeu_ps,
};

use crate::road::network::tensor::ChannelGrid;

/// See [`super::matrix_product`], which asserts the lengths.
#[target_feature(enable = "avx2,fma")]
pub(super) fn matrix_product(
    input: &[f32],
    matrix: &[f32],
    offsets: &[f32],
    least: f32,
    out: &mut [f32],
) {
    let outputs = offsets.len();
    let inputs = matrix.len() / outputs;
    let mut inputs_left = input.chunks_exact(4 * inputs);
    let mut out_left = out.chunks_exact_mut(4 * outputs);
    for (rows, places) in (&mut inputs_left).zip(&mut out_left) {
        for column in (0..outputs - outputs % 16).step_by(16) {
            block::<4, 2>(rows, matrix, offsets, least, column, places);
        }
        if !outputs.is_multiple_of(16) {
            block::<4, 1>(rows, matrix, offsets, least, outputs - 8, places);
        }
    }
    let rest = inputs_left.remainder().chunks_exact(inputs);
    for (row, place) in rest.zip(out_left.into_remainder().chunks_exact_mut(outputs)) {
        for column in (0..outputs).step_by(8) {
            block::<1, 1>(row, matrix, offsets, least, column, place);
        }
    }
}

/// Some outputs (8 in each of `VECTORS` registers, from `column` on) of some pixels.
#[inline]
#[target_feature(enable = "avx2,fma")]
fn block<const PIXELS: usize, const VECTORS: usize>(
    rows: &[f32],
    matrix: &[f32],
    offsets: &[f32],
    least: f32,
    column: usize,
    places: &mut [f32],
) {
    let outputs = offsets.len();
    let inputs = rows.len() / PIXELS;
    // SAFETY: `column` + 8 `VECTORS` is at most `outputs`, and there are as many rows of the matrix as inputs.
    unsafe {
        let start = offsets.as_ptr().wrapping_add(column);
        let start: [__m256; VECTORS] =
            std::array::from_fn(|v| _mm256_loadu_ps(start.wrapping_add(8 * v)));
        let mut sums = [start; PIXELS];
        let mut weights = matrix.as_ptr().wrapping_add(column);
        let mut values = rows.as_ptr();
        for _ in 0..inputs {
            let row: [__m256; VECTORS] =
                std::array::from_fn(|v| _mm256_loadu_ps(weights.wrapping_add(8 * v)));
            let mut value = values;
            for of_pixel in &mut sums {
                let broadcast = _mm256_set1_ps(*value);
                for (sum, weight) in of_pixel.iter_mut().zip(&row) {
                    *sum = _mm256_fmadd_ps(broadcast, *weight, *sum);
                }
                value = value.wrapping_add(inputs);
            }
            weights = weights.wrapping_add(outputs);
            values = values.wrapping_add(1);
        }
        let least = _mm256_set1_ps(least);
        let mut place = places.as_mut_ptr().wrapping_add(column);
        for of_pixel in sums {
            for (v, sum) in of_pixel.into_iter().enumerate() {
                _mm256_storeu_ps(place.wrapping_add(8 * v), _mm256_max_ps(sum, least));
            }
            place = place.wrapping_add(outputs);
        }
    }
}

/// See [`super::depthwise_row`], which asserts the lengths.
#[target_feature(enable = "avx2,fma")]
pub(super) fn depthwise_row(
    input: &ChannelGrid,
    row: usize,
    taps: &[f32],
    offsets: &[f32],
    apart: usize,
    least: f32,
    line: &mut [f32],
) {
    let sources = input.three_rows(row, apart);
    let (width, channels) = (input.width, input.channels);
    for column in (0..channels).step_by(8) {
        // SAFETY: `column` + 8 is at most the number of channels of every pixel, tap and offset.
        let kernel = unsafe {
            Kernel {
                taps: std::array::from_fn(|tap| {
                    _mm256_loadu_ps(taps.as_ptr().wrapping_add(tap * channels + column))
                }),
                offset: _mm256_loadu_ps(offsets.as_ptr().wrapping_add(column)),
                least: _mm256_set1_ps(least),
                apart,
                width,
                channels,
                column,
            }
        };
        let inner_end = width.saturating_sub(apart + 3).max(apart);
        let mut x = 0;
        while x < width {
            if (apart..inner_end).contains(&x) {
                kernel.pixels::<4>(&sources, x, line);
                x += 4;
            } else {
                kernel.pixels::<1>(&sources, x, line);
                x += 1;
            }
        }
    }
}

/// Taps of eight channels.
struct Kernel {
    taps: [__m256; 9],
    offset: __m256,
    least: __m256,
    apart: usize,
    width: usize,
    channels: usize,
    column: usize,
}

impl Kernel {
    /// Some pixels from `x` on, side by side; if there are several, all of their taps lie inside the picture.
    #[inline]
    #[target_feature(enable = "avx2,fma")]
    fn pixels<const PIXELS: usize>(&self, sources: &[&[f32]; 3], x: usize, line: &mut [f32]) {
        let mut sums = [self.offset; PIXELS];
        let first = x * self.channels + self.column;
        let reach = self.apart * self.channels;
        let (has_left, has_right) = (x >= self.apart, x + self.apart < self.width);
        for (source, taps) in sources.iter().zip(self.taps.chunks_exact(3)) {
            if source.is_empty() {
                continue;
            }
            let middle = source.as_ptr().wrapping_add(first);
            let places = [
                (has_left, middle.wrapping_sub(reach)),
                (true, middle),
                (has_right, middle.wrapping_add(reach)),
            ];
            for ((is_inside, place), tap) in places.into_iter().zip(taps) {
                if is_inside {
                    for (i, sum) in sums.iter_mut().enumerate() {
                        // SAFETY: the pixel lies inside the row, which has all channels of every pixel.
                        let value =
                            unsafe { _mm256_loadu_ps(place.wrapping_add(i * self.channels)) };
                        *sum = _mm256_fmadd_ps(value, *tap, *sum);
                    }
                }
            }
        }
        let out = line.as_mut_ptr().wrapping_add(first);
        for (i, sum) in sums.into_iter().enumerate() {
            // SAFETY: the line has all channels of every pixel.
            unsafe {
                _mm256_storeu_ps(
                    out.wrapping_add(i * self.channels),
                    _mm256_max_ps(sum, self.least),
                );
            }
        }
    }
}
