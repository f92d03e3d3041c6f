//! Kernels and pictures cut for the blocks of the inner loops.

use crate::raster::pool::Buffer;

/// Rows of output that one block computes.
pub(in super::super) const BLOCK_ROWS: usize = 4;
/// Columns of output that one block computes at most; a search row is padded by as many.
pub(in super::super) const BLOCK_COLUMNS: usize = 24;

/// A correlation kernel cut for blocks of [`BLOCK_ROWS`] output rows.
///
/// `taps[(s, x)][r]` is the kernel's pixel (x, s - r), zero outside of it: the weight that search
/// row s of a block carries towards the block's output row r.
#[derive(Clone, Debug)]
pub(in super::super) struct BlockKernel {
    pub width: usize,
    pub height: usize,
    pub taps: Vec<[f32; BLOCK_ROWS]>,
}

impl BlockKernel {
    /// Cuts a kernel given row by row.
    pub fn new(kernel: &[f32], width: usize, height: usize) -> Self {
        let mut taps = vec![[0.0; BLOCK_ROWS]; (height + BLOCK_ROWS - 1) * width];
        for (index, &value) in kernel.iter().enumerate() {
            let (x, y) = (index % width, index / width);
            for r in 0..BLOCK_ROWS {
                taps[(y + r) * width + x][r] = value;
            }
        }
        Self {
            width,
            height,
            taps,
        }
    }
}

/// A picture with zeros to the right and below, so that blocks may read past its edge.
#[derive(Clone, Debug)]
pub(in super::super) struct PaddedRows {
    pub stride: usize,
    pub pixels: Buffer<f32>,
}

impl PaddedRows {
    /// Pads `pixels`, `width` in each row.
    pub fn new(pixels: &[f32], width: usize) -> Self {
        let stride = width + BLOCK_COLUMNS;
        let height = pixels.len().checked_div(width).unwrap_or(0);
        let mut padded = Buffer::<f32>::zeros(stride * (height + BLOCK_ROWS));
        for (target, source) in padded
            .chunks_exact_mut(stride)
            .zip(pixels.chunks_exact(width.max(1)))
        {
            target[..width].copy_from_slice(source);
        }
        Self {
            stride,
            pixels: padded,
        }
    }
}
