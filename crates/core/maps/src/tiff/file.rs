//! A TIFF file as images whose tiles are read when they are wanted.

use std::sync::Arc;

use super::decompress::unpack;
use super::directory::BlockReader;
use super::error::Blame;
use super::samples::from_bytes;
use super::{Chunk, Directory, FillOrder, Photometric, TiffError, TiffLayout, TileSamples};
use pilotage_base::bytes::ByteSource;

/// An open TIFF file: the picture, its smaller copies and their masks.
#[derive(Clone)]
pub struct TiffFile {
    source: Arc<dyn ByteSource>,
    /// Tags of the picture itself.
    pub(crate) directory: Directory,
    /// The picture, then its overviews from fine to coarse.
    levels: Vec<TiffLayout>,
    /// For every level the mask of valid pixels, where the file has one.
    masks: Vec<Option<TiffLayout>>,
}

impl TiffFile {
    /// Reads the directories of a file.
    pub fn open(source: Arc<dyn ByteSource>) -> Result<Self, TiffError> {
        let (mut reader, first) = BlockReader::open(source.as_ref())?;
        let directories = reader.directories(first)?;
        let blame = Blame {
            file: source.name(),
            place: "header",
        };
        let mut images = directories.into_iter();
        let directory = images
            .next()
            .ok_or_else(|| blame.damaged("it holds no image"))?;
        let picture = TiffLayout::from_directory(&directory)?;
        let (width, height) = (picture.width, picture.height);
        let mut levels = vec![picture];
        let mut masks = Vec::new();
        for other in images {
            // A second picture, or an overview of a kind that is not read, is no reason to refuse
            // the first.
            let Ok(layout) = TiffLayout::from_directory(&other) else {
                continue;
            };
            if layout.photometric == Photometric::Mask {
                masks.push(layout);
            } else if layout.is_overview
                && layout.samples == levels[0].samples
                && layout.kind == levels[0].kind
                && layout.width < width
                && layout.height <= height
            {
                levels.push(layout);
            }
        }
        levels[1..].sort_by_key(|level| std::cmp::Reverse(level.width));
        let masks = levels
            .iter()
            .map(|level| {
                let fits = |m: &&TiffLayout| (m.width, m.height) == (level.width, level.height);
                masks.iter().find(fits).cloned()
            })
            .collect();
        Ok(Self {
            source,
            directory,
            levels,
            masks,
        })
    }

    /// Name of the file.
    pub fn name(&self) -> &str {
        self.source.name()
    }

    /// Bytes of the file.
    pub fn length(&self) -> u64 {
        self.source.length()
    }

    /// The picture, then its overviews from fine to coarse.
    pub fn levels(&self) -> &[TiffLayout] {
        &self.levels
    }

    /// The mask of a level, where the file has one.
    pub fn mask(&self, level: usize) -> Option<&TiffLayout> {
        self.masks.get(level)?.as_ref()
    }

    /// The tile or strip of a level in that column and row of tiles; `None` where the file leaves
    /// it out, as files with large empty areas do.
    ///
    /// # Panics
    /// If there is no such level or tile.
    pub fn chunk(
        &self,
        level: usize,
        column: usize,
        row: usize,
    ) -> Result<Option<Chunk>, TiffError> {
        self.chunk_of(&self.levels[level], column, row, level, "tile")
    }

    /// As [`chunk`](Self::chunk) for a level's mask; `None` also where there is no mask.
    pub fn mask_chunk(
        &self,
        level: usize,
        column: usize,
        row: usize,
    ) -> Result<Option<Chunk>, TiffError> {
        match self.mask(level) {
            Some(mask) => self.chunk_of(mask, column, row, level, "mask tile"),
            None => Ok(None),
        }
    }

    fn chunk_of(
        &self,
        layout: &TiffLayout,
        column: usize,
        row: usize,
        level: usize,
        what: &str,
    ) -> Result<Option<Chunk>, TiffError> {
        assert!(
            column < layout.across() && row < layout.down(),
            "no such tile"
        );
        let what = if layout.is_tiled { what } else { "strip" };
        let place = match level {
            0 => format!("{what} {column}, {row}"),
            _ => format!("{what} {column}, {row} of overview {level}"),
        };
        let blame = Blame {
            file: self.source.name(),
            place: &place,
        };
        let planes = if layout.is_planar { layout.samples } else { 1 };
        let rows = layout.stored_rows(row);
        let mut found = Vec::with_capacity(planes);
        for plane in 0..planes {
            let (offset, count) = layout.place(plane, column, row);
            if count == 0 {
                return Ok(None);
            }
            let end = offset.checked_add(count);
            if end.is_none_or(|end| end > self.source.length()) {
                return Err(blame.damaged(format!(
                    "{count} bytes at byte {offset} would lie beyond the end of the file at {}",
                    self.source.length()
                )));
            }
            let mut packed =
                (self.source.read(offset, count as usize)).map_err(|e| blame.read(e))?;
            if layout.bit_order == FillOrder::LeastFirst {
                packed = packed.into_iter().map(u8::reverse_bits).collect();
            }
            let expected = layout
                .kind
                .row_bytes(layout.chunk_width * layout.samples_together())
                * rows;
            let bytes = unpack(layout, packed, (layout.chunk_width, rows), expected)
                .map_err(|cause| blame.damaged(cause))?;
            if bytes.len() != expected {
                return Err(
                    blame.damaged(format!("it unpacks to {} bytes of {expected}", bytes.len()))
                );
            }
            found.push(from_bytes(layout, bytes, layout.chunk_width));
        }
        let samples = if layout.is_planar {
            TileSamples::interleaved(found)
        } else {
            found.pop()
        };
        let samples = samples.ok_or_else(|| blame.damaged("it has no samples"))?;
        Ok(Some(Chunk {
            width: layout.chunk_width,
            height: rows,
            samples_per_pixel: layout.samples,
            samples,
        }))
    }
}
