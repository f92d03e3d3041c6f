//! Layout of a table's numbers in memory.

/// Numbers that a table has more than it needs: vectors may be read beyond the last window.
pub(super) const SLACK: usize = 32;

/// Layout of the rows of a table, one number longer than the picture's.
///
/// Where only every other window is looked at, numbers of even columns come first in a row and then those
/// of odd ones: what neighbouring windows ask for lies side by side in any case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct RowGrid {
    /// Numbers in a row.
    pub stride: usize,
    /// Pixels from one window to the next: 1 or 2.
    pub step: usize,
    /// Numbers of even columns in a row, if `step` is 2.
    half: usize,
}

impl RowGrid {
    /// For pictures of that width.
    pub fn new(width: usize, step: usize) -> Self {
        let half = (width + 1).div_ceil(2);
        Self {
            stride: if step == 2 { 2 * half } else { width + 1 },
            step,
            half,
        }
    }

    /// Place of the number at (x, y) of a table, or from a window's place to that of (x, y) in the window.
    pub fn place(&self, x: usize, y: usize) -> usize {
        if self.step == 2 {
            y * self.stride + (x % 2) * self.half + x / 2
        } else {
            y * self.stride + x
        }
    }

    /// Makes a table long enough for a picture of that height; its first row is zeros.
    pub fn prepare(&self, height: usize, table: &mut Vec<i32>) {
        table.resize(self.stride * (height + 1) + SLACK, 0);
        table[..self.stride].fill(0);
    }

    /// Stores row `y` of a table, given from left to right.
    pub fn store(&self, row: &[i32], y: usize, table: &mut [i32]) {
        let out = &mut table[y * self.stride..][..self.stride];
        if self.step == 2 {
            let (even, odd) = out.split_at_mut(self.half);
            let pairs = row.chunks_exact(2);
            if let ([last], Some(out)) = (pairs.remainder(), even.last_mut()) {
                *out = *last;
            }
            for ((pair, even), odd) in pairs.zip(even).zip(odd) {
                (*even, *odd) = (pair[0], pair[1]);
            }
        } else {
            out.copy_from_slice(row);
        }
    }
}
