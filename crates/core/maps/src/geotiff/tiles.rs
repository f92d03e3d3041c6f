//! Rectangles out of the levels of a TIFF file, through a bounded memory of unpacked tiles.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::super::tiff::{TiffError, TiffFile};
use super::colour::Colours;
use super::mask::{TileIndex, for_hidden, overlapping};
use pilotage_raster::imagery::kept::RecentValues;
use pilotage_raster::raster::{Raster, Rgba};

/// Most problems that are remembered.
const MOST_PROBLEMS: usize = 16;

/// The coloured tiles of a file.
pub(super) struct ColouredTiles {
    pub file: TiffFile,
    pub colours: Colours,
    kept: RecentValues<TileIndex, Raster<Rgba>>,
    problems: Mutex<Vec<TiffError>>,
    /// Number of times that the bytes of a tile could not be had.
    unreached: AtomicUsize,
}

impl ColouredTiles {
    /// Tiles of `file`, of which at most `most_bytes` are kept.
    pub fn new(file: TiffFile, colours: Colours, most_bytes: usize) -> Self {
        Self {
            file,
            colours,
            kept: RecentValues::new(most_bytes),
            problems: Mutex::new(Vec::new()),
            unreached: AtomicUsize::new(0),
        }
    }

    /// The first tiles that could not be read.
    pub fn problems(&self) -> Vec<TiffError> {
        let problems = self.problems.lock().unwrap_or_else(PoisonError::into_inner);
        problems.clone()
    }

    /// Number of times that the bytes of a tile could not be had, which may be otherwise the next time.
    pub fn unreached(&self) -> usize {
        self.unreached.load(Ordering::Relaxed)
    }

    fn remember(&self, problem: TiffError) {
        if matches!(problem, TiffError::Read { .. }) {
            self.unreached.fetch_add(1, Ordering::Relaxed);
        }
        let mut problems = self.problems.lock().unwrap_or_else(PoisonError::into_inner);
        if problems.len() < MOST_PROBLEMS && !problems.contains(&problem) {
            problems.push(problem);
        }
    }

    fn read(&self, (level, column, row): TileIndex) -> Result<Raster<Rgba>, TiffError> {
        let layout = &self.file.levels()[level];
        let chunk = self.file.chunk(level, column, row)?;
        let mut tile = self.colours.paint(layout, chunk.as_ref());
        let size = (tile.width(), tile.height());
        for_hidden(&self.file, (level, column, row), size, &mut |x, y| {
            tile.set(x, y, [0; 4]);
        })?;
        Ok(tile)
    }

    /// The tile at a place; transparent if it cannot be read, which is remembered as a problem.
    fn tile(&self, place: TileIndex) -> Arc<Raster<Rgba>> {
        let made = self.kept.get_or_make(place, || {
            let tile = self.read(place)?;
            let bytes = tile.pixels().len() * 4;
            Ok((tile, bytes))
        });
        made.unwrap_or_else(|problem| {
            self.remember(problem);
            Arc::new(Raster::filled(0, 0, [0; 4]))
        })
    }

    /// The pixels of a level from `first` (column and row) to before `end`.
    pub fn rectangle(
        &self,
        level: usize,
        first: (usize, usize),
        end: (usize, usize),
    ) -> Raster<Rgba> {
        let layout = &self.file.levels()[level];
        let mut out = Raster::filled(end.0 - first.0, end.1 - first.1, [0; 4]);
        for (column, row) in overlapping(layout, first, end) {
            let tile = self.tile((level, column, row));
            let corner = (column * layout.chunk_width, row * layout.chunk_height);
            let columns = first.0.max(corner.0)..end.0.min(corner.0 + tile.width());
            if columns.is_empty() {
                continue;
            }
            for y in first.1.max(corner.1)..end.1.min(corner.1 + tile.height()) {
                let source = &tile.row(y - corner.1)[columns.start - corner.0..][..columns.len()];
                out.row_mut(y - first.1)[columns.start - first.0..][..columns.len()]
                    .copy_from_slice(source);
            }
        }
        out
    }
}
