//! Places of windows in the tables, as many at once as a vector holds.

use crate::landmark::cascade::grid::SLACK;
use crate::landmark::cascade::layout::CornerSum;

/// Windows that one step works on.
pub(super) const LANES: usize = 8;

/// A number for each of them.
pub(super) type Lanes<T> = [T; LANES];

const _: () = assert!(LANES <= SLACK, "tables are longer by a vector");

/// Places of windows in the tables.
pub(super) trait WindowPlaces {
    /// Sums over a rectangle, given by its corners relative to each window, below the reach of the
    /// program.
    fn sums(&self, table: &[i32], corners: &CornerSum) -> Lanes<i32>;

    /// Entries at points relative to each window, below the reach of the program.
    fn entries(&self, table: &[i32], points: &[usize; 16]) -> [Lanes<i32>; 16];
}

/// Windows side by side, from this place on.
pub(super) struct SideBySide(pub usize);

impl WindowPlaces for SideBySide {
    #[inline(always)]
    fn sums(&self, table: &[i32], corners: &CornerSum) -> Lanes<i32> {
        // SAFETY: whoever votes asserted that this place plus reach plus lanes lies in the table.
        let [a, b, c, d] = corners
            .map(|corner| unsafe { table.get_unchecked(self.0 + corner..self.0 + corner + LANES) });
        let mut sums = [0; LANES];
        for i in 0..LANES {
            sums[i] = a[i]
                .wrapping_sub(b[i])
                .wrapping_sub(c[i])
                .wrapping_add(d[i]);
        }
        sums
    }

    #[inline(always)]
    fn entries(&self, table: &[i32], points: &[usize; 16]) -> [Lanes<i32>; 16] {
        let mut entries = [[0; LANES]; 16];
        for (entry, point) in entries.iter_mut().zip(points) {
            // SAFETY: as above.
            let from = unsafe { table.get_unchecked(self.0 + point..self.0 + point + LANES) };
            entry.copy_from_slice(from);
        }
        entries
    }
}

/// Windows anywhere.
pub(super) struct Scattered(pub Lanes<usize>);

impl WindowPlaces for Scattered {
    #[inline(always)]
    fn sums(&self, table: &[i32], corners: &CornerSum) -> Lanes<i32> {
        let mut sums = [0; LANES];
        for i in 0..LANES {
            // SAFETY: whoever votes asserted that the last place plus reach lies in the table.
            let [a, b, c, d] =
                corners.map(|corner| unsafe { *table.get_unchecked(self.0[i] + corner) });
            sums[i] = a.wrapping_sub(b).wrapping_sub(c).wrapping_add(d);
        }
        sums
    }

    #[inline(always)]
    fn entries(&self, table: &[i32], points: &[usize; 16]) -> [Lanes<i32>; 16] {
        let mut entries = [[0; LANES]; 16];
        for (entry, point) in entries.iter_mut().zip(points) {
            for i in 0..LANES {
                // SAFETY: as above.
                entry[i] = unsafe { *table.get_unchecked(self.0[i] + point) };
            }
        }
        entries
    }
}
