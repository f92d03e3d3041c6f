//! Masks inside a TIFF file: pixels of a level that are not to be shown.

use super::super::tiff::{Chunk, TiffError, TiffFile, TiffLayout};

/// Level, column and row of a tile.
pub(super) type TileIndex = (usize, usize, usize);

/// Calls `hide` with column and row, within a tile of that size, of every pixel that the mask of its level leaves out; of none
/// where there is no mask.
pub(super) fn for_hidden(
    file: &TiffFile,
    (level, column, row): TileIndex,
    (width, height): (usize, usize),
    hide: &mut dyn FnMut(usize, usize),
) -> Result<(), TiffError> {
    let Some(mask) = file.mask(level) else {
        return Ok(());
    };
    let layout = &file.levels()[level];
    let first = (column * layout.chunk_width, row * layout.chunk_height);
    let end = (
        (first.0 + width).min(mask.width),
        (first.1 + height).min(mask.height),
    );
    for (mask_column, mask_row) in overlapping(mask, first, end) {
        let chunk = file.mask_chunk(level, mask_column, mask_row)?;
        let corner = (mask_column * mask.chunk_width, mask_row * mask.chunk_height);
        for y in first.1.max(corner.1)..end.1.min(corner.1 + mask.chunk_height) {
            for x in first.0.max(corner.0)..end.0.min(corner.0 + mask.chunk_width) {
                if !is_set(chunk.as_ref(), x - corner.0, y - corner.1) {
                    hide(x - first.0, y - first.1);
                }
            }
        }
    }
    Ok(())
}

/// Columns and rows of the tiles of `layout` that share pixels with the rectangle.
pub(super) fn overlapping(
    layout: &TiffLayout,
    first: (usize, usize),
    end: (usize, usize),
) -> impl Iterator<Item = (usize, usize)> + use<> {
    let columns = first.0 / layout.chunk_width..end.0.div_ceil(layout.chunk_width);
    let rows = first.1 / layout.chunk_height..end.1.div_ceil(layout.chunk_height);
    rows.flat_map(move |row| columns.clone().map(move |column| (column, row)))
}

/// Whether a pixel of a mask's tile is valid; tiles that are left out are not.
fn is_set(chunk: Option<&Chunk>, x: usize, y: usize) -> bool {
    chunk.is_some_and(|chunk| {
        let index = (y * chunk.width + x) * chunk.samples_per_pixel;
        y < chunk.height && chunk.samples.real(index) != 0.0
    })
}
