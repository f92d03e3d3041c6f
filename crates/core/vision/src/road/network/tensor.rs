//! Pixels of several channels.

/// Rows of pixels, the channels of a pixel side by side.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelGrid {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Channels of a pixel.
    pub channels: usize,
    /// All values.
    pub values: Vec<f32>,
}

impl ChannelGrid {
    /// Zeros.
    pub fn zeros(width: usize, height: usize, channels: usize) -> Self {
        Self {
            width,
            height,
            channels,
            values: vec![0.0; width * height * channels],
        }
    }

    /// Squares of two by two pixels as one pixel of four times the channels; width and height are even.
    #[must_use]
    pub fn folded(&self) -> Self {
        let mut out = Self::zeros(self.width / 2, self.height / 2, 4 * self.channels);
        let rows = out.values.chunks_exact_mut(2 * self.width * self.channels);
        for (row, line) in rows.enumerate() {
            self.fold_row(row, line);
        }
        out
    }

    /// A row of what [`folded`](Self::folded) gives.
    pub(super) fn fold_row(&self, row: usize, line: &mut [f32]) {
        let pair = 2 * self.channels;
        let row_length = self.width * self.channels;
        let upper = &self.values[2 * row * row_length..][..row_length];
        let lower = &self.values[(2 * row + 1) * row_length..][..row_length];
        let pairs = upper.chunks_exact(pair).zip(lower.chunks_exact(pair));
        for (pixel, (above, below)) in line.chunks_exact_mut(2 * pair).zip(pairs) {
            pixel[..pair].copy_from_slice(above);
            pixel[pair..].copy_from_slice(below);
        }
    }

    /// The rows above, on and below a row, `apart` pixels apart; empty where there is none.
    pub(super) fn three_rows(&self, row: usize, apart: usize) -> [&[f32]; 3] {
        let length = self.width * self.channels;
        std::array::from_fn(|i| {
            let from = (row + i * apart).checked_sub(apart);
            let from = from.filter(|r| *r < self.height);
            from.map_or(&[][..], |r| &self.values[r * length..][..length])
        })
    }

    /// The reverse of [`folded`](Self::folded).
    #[must_use]
    pub fn unfolded(&self) -> Self {
        let mut out = Self::zeros(2 * self.width, 2 * self.height, self.channels / 4);
        let pair = self.channels / 2;
        let row_length = out.width * out.channels;
        for (y, lines) in out.values.chunks_exact_mut(2 * row_length).enumerate() {
            let (upper, lower) = lines.split_at_mut(row_length);
            let source = &self.values[y * 2 * row_length..][..2 * row_length];
            let pairs = upper
                .chunks_exact_mut(pair)
                .zip(lower.chunks_exact_mut(pair));
            for (pixel, (above, below)) in source.chunks_exact(2 * pair).zip(pairs) {
                above.copy_from_slice(&pixel[..pair]);
                below.copy_from_slice(&pixel[pair..]);
            }
        }
        out
    }

    /// Adds another grid of the same size; below zero cut if `cut`.
    pub fn add(&mut self, other: &Self, cut: bool) {
        let least = if cut { 0.0 } else { f32::NEG_INFINITY };
        for (value, more) in self.values.iter_mut().zip(&other.values) {
            *value = (*value + more).max(least);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fold_brings_four_pixels_together_and_is_undone() {
        let mut grid = ChannelGrid::zeros(4, 2, 3);
        for (i, value) in grid.values.iter_mut().enumerate() {
            *value = i as f32;
        }
        let folded = grid.folded();
        assert_eq!((folded.width, folded.height, folded.channels), (2, 1, 12));
        let first = [0, 1, 2, 3, 4, 5, 12, 13, 14, 15, 16, 17].map(|v: u8| f32::from(v));
        assert_eq!(folded.values[..12], first);
        assert_eq!(folded.unfolded(), grid);
    }
}
