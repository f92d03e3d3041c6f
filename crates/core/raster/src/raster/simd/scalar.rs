//! Plain loops: what the vector ones are tested against, and the way out where there are none.

use super::blocks::{BLOCK_ROWS, BlockKernel, PaddedRows};

/// See [`super::correlate`]; `out` is zero on entry.
pub(super) fn correlate(
    search: &PaddedRows,
    kernel: &BlockKernel,
    out: &mut [f32],
    stride: usize,
    rows: usize,
) {
    for (y, line) in out.chunks_exact_mut(stride).take(rows).enumerate() {
        for j in 0..kernel.height {
            let source = &search.pixels[(y + j) * search.stride..][..search.stride];
            // Output row 0 of a block sees the kernel as it is.
            let taps: &[[f32; BLOCK_ROWS]] = &kernel.taps[j * kernel.width..][..kernel.width];
            for (i, tap) in taps.iter().enumerate() {
                let available = (search.stride - i).min(stride);
                for (sum, &value) in line[..available].iter_mut().zip(&source[i..]) {
                    *sum += tap[0] * value;
                }
            }
        }
    }
}
