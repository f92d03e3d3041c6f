//! A template over a whole picture, in tiles where it is large.

use std::ops::Range;

use super::cost;
use super::flatness::flat_level;
use super::search::SearchSpectrum;
use super::template::Template;
use crate::raster::Gray;

impl Template {
    /// The correlation surface over all places at which the template lies inside `search`:
    /// value (c, r) belongs to the template with its top-left corner at the corner (c, r).
    ///
    /// Its size is `search.width() - width + 1` by `search.height() - height + 1`; empty if the
    /// template does not fit. Values lie in [-1, 1], 0 over flat windows.
    pub fn correlate(&self, search: &Gray) -> Gray {
        let tile = cost::tile(search.width(), search.height(), self.width, self.height);
        if tile == (search.width(), search.height()) {
            return SearchSpectrum::new(search).correlate(self);
        }
        // Large pictures go in overlapping tiles that fit the cache. All have one size, so that
        // the template is transformed once; the last ones overlap more.
        let columns = search.width() - self.width + 1;
        let rows = search.height() - self.height + 1;
        let (step_x, step_y) = (tile.0 - self.width + 1, tile.1 - self.height + 1);
        let flat = flat_level(search.pixels());
        let mut surface = Gray::filled(columns, rows, 0.0);
        for top in (0..rows).step_by(step_y) {
            let top = top.min(search.height() - tile.1);
            for left in (0..columns).step_by(step_x) {
                let left = left.min(search.width() - tile.0);
                let Some(part) = search.crop(left, top, tile.0, tile.1) else {
                    continue;
                };
                let part = SearchSpectrum::with_flat_level(&part, flat).correlate(self);
                for row in 0..part.height() {
                    surface.row_mut(top + row)[left..left + part.width()]
                        .copy_from_slice(part.row(row));
                }
            }
        }
        surface
    }

    /// The part of the surface of [`Self::correlate`] for the given offsets, cut where it ends;
    /// for a dense look around a place found on a coarser level.
    pub fn correlate_at(&self, search: &Gray, columns: Range<usize>, rows: Range<usize>) -> Gray {
        let end =
            |wanted: usize, whole: usize, own: usize| wanted.min((whole + 1).saturating_sub(own));
        let last_column = end(columns.end, search.width(), self.width);
        let last_row = end(rows.end, search.height(), self.height);
        if columns.start >= last_column || rows.start >= last_row {
            return Gray::filled(0, 0, 0.0);
        }
        search
            .crop(
                columns.start,
                rows.start,
                last_column - columns.start + self.width - 1,
                last_row - rows.start + self.height - 1,
            )
            .map_or_else(
                || Gray::filled(0, 0, 0.0),
                |part| {
                    SearchSpectrum::with_flat_level(&part, flat_level(search.pixels()))
                        .correlate(self)
                },
            )
    }
}
