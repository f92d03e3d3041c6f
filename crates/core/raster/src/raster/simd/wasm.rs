//! WebAssembly's 128-bit vectors.
#![expect(
    unsafe_code,
    clippy::cast_ptr_alignment,
    reason = "vector loads and stores take pointers of any alignment; every block's bounds are asserted first"
)]

use std::arch::wasm32::{f32x4_add, f32x4_mul, f32x4_splat, v128, v128_load, v128_store};

use super::blocks::{BLOCK_ROWS, BlockKernel, PaddedRows};

/// See [`super::correlate`].
pub(super) fn correlate(
    search: &PaddedRows,
    kernel: &BlockKernel,
    out: &mut [f32],
    stride: usize,
    rows: usize,
) {
    // The last block computes rows beyond the last and does not write them.
    let padded_rows = rows.next_multiple_of(BLOCK_ROWS);
    assert!(stride.is_multiple_of(8) && stride * rows <= out.len());
    assert!(kernel.width - 1 + stride <= search.stride);
    assert!((padded_rows + kernel.height - 1) * search.stride <= search.pixels.len());
    assert!(kernel.taps.len() >= (kernel.height + BLOCK_ROWS - 1) * kernel.width);
    for y in (0..padded_rows).step_by(BLOCK_ROWS) {
        for x in (0..stride).step_by(8) {
            // SAFETY: a block reads search rows y..y + kernel.height + 3 and columns up to
            // x + 8 + kernel.width - 1 <= search.stride, and writes rows y..rows and columns
            // x..x + 8; all of them lie inside by the assertions above.
            unsafe {
                block(
                    search,
                    kernel,
                    out,
                    stride,
                    x,
                    y,
                    (rows - y).min(BLOCK_ROWS),
                );
            }
        }
    }
}

/// Four rows of eight columns.
unsafe fn block(
    search: &PaddedRows,
    kernel: &BlockKernel,
    out: &mut [f32],
    stride: usize,
    x: usize,
    y: usize,
    rows: usize,
) {
    // SAFETY: see the caller.
    unsafe {
        let mut sums = [[f32x4_splat(0.0); 2]; BLOCK_ROWS];
        for s in 0..kernel.height + BLOCK_ROWS - 1 {
            let mut source = search.pixels.as_ptr().add((y + s) * search.stride + x);
            let mut taps = kernel.taps.as_ptr().add(s * kernel.width);
            for _ in 0..kernel.width {
                let left = v128_load(source.cast::<v128>());
                let right = v128_load(source.add(4).cast::<v128>());
                for (row, &weight) in sums.iter_mut().zip(&*taps) {
                    let weight = f32x4_splat(weight);
                    row[0] = f32x4_add(row[0], f32x4_mul(weight, left));
                    row[1] = f32x4_add(row[1], f32x4_mul(weight, right));
                }
                source = source.add(1);
                taps = taps.add(1);
            }
        }
        for (r, row) in sums.iter().take(rows).enumerate() {
            let target = out.as_mut_ptr().add((y + r) * stride + x);
            v128_store(target.cast::<v128>(), row[0]);
            v128_store(target.add(4).cast::<v128>(), row[1]);
        }
    }
}
