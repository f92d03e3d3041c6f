//! A coarse pyramid for files that bring none, made block by block as it is needed.

use super::tiles::ColouredTiles;
use pilotage_raster::imagery::resample::halved;
use pilotage_raster::raster::{Raster, Rgba};

/// Pixels of the finest level along the side of a block.
const BLOCK: usize = 1024;
/// A level with no more pixels needs nothing coarser.
const SMALL: usize = 2048 * 2048;

/// Copies of a level at a power of two and coarser.
pub(super) struct Coarse {
    /// The level of the file that is the source.
    pub level: usize,
    /// Pixels of that level per pixel of the finest copy.
    pub factor: usize,
    /// The copies, each half of the one before; made room for when the first is needed, so that a map
    /// of which nothing is drawn takes none.
    copies: Vec<Raster<Rgba>>,
    /// Their sizes.
    sizes: Vec<(usize, usize)>,
    /// Size of a block in pixels of the source.
    block: (usize, usize),
    /// Blocks from left to right.
    across: usize,
    done: Vec<bool>,
}

impl Coarse {
    /// Prepares the copies of the coarsest level of a file for `most_bytes`; `None` if that is small.
    pub fn new(tiles: &ColouredTiles, most_bytes: usize) -> Option<Self> {
        let level = tiles.file.levels().len() - 1;
        let layout = &tiles.file.levels()[level];
        if layout.width * layout.height <= SMALL {
            return None;
        }
        let mut factor: usize = 4;
        // All copies together take a third more than the finest.
        let bytes = |f: usize| layout.width.div_ceil(f) * layout.height.div_ceil(f) * 4 / 3 * 4;
        while bytes(factor) > most_bytes {
            factor *= 2;
        }
        // Blocks are whole tiles, or whole rows of strips, and whole pixels of the copies.
        let up_to = |chunk: usize, pixels: usize| chunk * pixels.div_ceil(chunk);
        let width = if layout.is_tiled {
            up_to(layout.chunk_width, BLOCK).next_multiple_of(factor)
        } else {
            // One column of blocks may end anywhere.
            layout.width.next_multiple_of(64 * factor)
        };
        let rows = (BLOCK * BLOCK / width).clamp(1, BLOCK);
        let block = (
            width,
            up_to(layout.chunk_height, rows).next_multiple_of(8 * factor),
        );
        let across = layout.width.div_ceil(block.0);
        let down = layout.height.div_ceil(block.1);
        let mut sizes = Vec::new();
        let mut f = factor;
        // As deep as blocks stay whole pixels; what is coarser yet is averaged from the last.
        while block.0.is_multiple_of(f) && block.1.is_multiple_of(f) && f <= 64 * factor {
            sizes.push((layout.width.div_ceil(f), layout.height.div_ceil(f)));
            f *= 2;
        }
        Some(Self {
            level,
            factor,
            copies: Vec::new(),
            sizes,
            block,
            across,
            done: vec![false; across * down],
        })
    }

    /// The copies, transparent where they are not made yet.
    pub fn copies(&mut self) -> &mut [Raster<Rgba>] {
        if self.copies.is_empty() {
            let empty = |(width, height): &(usize, usize)| Raster::filled(*width, *height, [0; 4]);
            self.copies = self.sizes.iter().map(empty).collect();
        }
        &mut self.copies
    }

    /// Blocks that are made, and all blocks.
    pub fn progress(&self) -> (usize, usize) {
        (
            self.done.iter().filter(|done| **done).count(),
            self.done.len(),
        )
    }

    /// The first block that is not made yet.
    pub fn pending(&self) -> Option<usize> {
        self.done.iter().position(|done| !done)
    }

    /// Blocks that share pixels of the source with the rectangle and are not made yet.
    pub fn missing(&self, first: (usize, usize), end: (usize, usize)) -> Vec<usize> {
        let rows = first.1 / self.block.1..end.1.div_ceil(self.block.1);
        let columns = first.0 / self.block.0..end.0.div_ceil(self.block.0);
        rows.flat_map(|row| columns.clone().map(move |column| (column, row)))
            .map(|(column, row)| row * self.across + column)
            .filter(|block| self.done.get(*block) == Some(&false))
            .collect()
    }

    /// Makes a block.
    pub fn make(&mut self, tiles: &ColouredTiles, block: usize) {
        let layout = &tiles.file.levels()[self.level];
        let (column, row) = (block % self.across, block / self.across);
        let first = (column * self.block.0, row * self.block.1);
        let end = (
            (first.0 + self.block.0).min(layout.width),
            (first.1 + self.block.1).min(layout.height),
        );
        let mut pixels = tiles.rectangle(self.level, first, end);
        let mut f = 1;
        while f < self.factor {
            pixels = halved(&pixels);
            f *= 2;
        }
        for copy in self.copies() {
            let corner = (first.0 / f, first.1 / f);
            for y in 0..pixels.height().min(copy.height() - corner.1) {
                let width = pixels.width().min(copy.width() - corner.0);
                copy.row_mut(corner.1 + y)[corner.0..][..width]
                    .copy_from_slice(&pixels.row(y)[..width]);
            }
            pixels = halved(&pixels);
            f *= 2;
        }
        self.done[block] = true;
    }
}
