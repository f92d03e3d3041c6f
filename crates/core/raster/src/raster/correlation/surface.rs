//! Correlation before it is normalised.

use crate::raster::pool::Buffer;

/// Values of a correlation, rows `stride` apart.
pub(super) struct CorrelationSurface {
    pub stride: usize,
    pub values: Buffer<f32>,
}

impl CorrelationSurface {
    pub fn at(&self, x: usize, y: usize) -> f32 {
        self.values[y * self.stride + x]
    }
}
