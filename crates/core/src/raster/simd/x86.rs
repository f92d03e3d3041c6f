//! AVX2 with fused multiply-add.
#![expect(
    unsafe_code,
    reason = "vector loads and stores take pointers; every block's bounds are asserted first"
)]

use std::arch::x86_64::{
    _mm256_fmadd_ps, _mm256_loadu_ps, _mm256_set1_ps, _mm256_setzero_ps, _mm256_storeu_ps,
};

use super::{BLOCK_ROWS, BlockKernel, PaddedRows};

/// See [`super::correlate`]; answers false when the processor has no AVX2 with FMA.
pub(super) fn correlate(
    search: &PaddedRows,
    kernel: &BlockKernel,
    out: &mut [f32],
    stride: usize,
    rows: usize,
) -> bool {
    if !(is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")) {
        return false;
    }
    let padded_rows = rows.next_multiple_of(BLOCK_ROWS);
    assert!(stride.is_multiple_of(8) && stride * padded_rows <= out.len());
    assert!(kernel.width - 1 + stride <= search.stride);
    let deepest = padded_rows + kernel.height - 1;
    assert!(deepest * search.stride <= search.pixels.len());
    assert!(kernel.taps.len() >= (kernel.height + BLOCK_ROWS - 1) * kernel.width);
    for y in (0..padded_rows).step_by(BLOCK_ROWS) {
        let mut x = 0;
        while x < stride {
            // SAFETY: the instructions were detected above. A block reads search rows
            // y..y + kernel.height + 3 < `deepest` and columns up to x + 8K + kernel.width - 1
            // <= search.stride, and writes rows y..y + 4 <= `padded_rows`, columns x..x + 8K <= stride.
            x += match stride - x {
                8 => unsafe { block::<1>(search, kernel, out, stride, x, y) },
                16 | 32 => unsafe { block::<2>(search, kernel, out, stride, x, y) },
                _ => unsafe { block::<3>(search, kernel, out, stride, x, y) },
            };
        }
    }
    true
}

/// Four rows of 8 K columns; answers the number of columns done.
///
/// Twelve accumulators, three loads and four broadcasts for twelve multiply-adds (K = 3) keep both
/// multipliers of the core busy.
#[target_feature(enable = "avx2,fma")]
unsafe fn block<const K: usize>(
    search: &PaddedRows,
    kernel: &BlockKernel,
    out: &mut [f32],
    stride: usize,
    x: usize,
    y: usize,
) -> usize {
    // SAFETY: see the caller.
    unsafe {
        let mut sums = [[_mm256_setzero_ps(); K]; BLOCK_ROWS];
        for s in 0..kernel.height + BLOCK_ROWS - 1 {
            let mut source = search.pixels.as_ptr().add((y + s) * search.stride + x);
            let mut taps = kernel.taps.as_ptr().add(s * kernel.width);
            for _ in 0..kernel.width {
                let tap = &*taps;
                let mut values = [_mm256_setzero_ps(); K];
                for (k, value) in values.iter_mut().enumerate() {
                    *value = _mm256_loadu_ps(source.add(8 * k));
                }
                for (row, &weight) in sums.iter_mut().zip(tap) {
                    let weight = _mm256_set1_ps(weight);
                    for (sum, &value) in row.iter_mut().zip(&values) {
                        *sum = _mm256_fmadd_ps(weight, value, *sum);
                    }
                }
                source = source.add(1);
                taps = taps.add(1);
            }
        }
        for (r, row) in sums.iter().enumerate() {
            let target = out.as_mut_ptr().add((y + r) * stride + x);
            for (k, &sum) in row.iter().enumerate() {
                _mm256_storeu_ps(target.add(8 * k), sum);
            }
        }
    }
    8 * K
}
