//! `PMTiles`, version 3: all tiles of a map in one file.
//!
//! After the specification of Protomaps: a header of 127 bytes, directories in two steps, tiles in
//! the order of Hilbert's curve.

use std::f64::consts::TAU;
use std::io::Read;
use std::sync::Arc;

use flate2::read::GzDecoder;

use super::metadata::ArchiveMetadata;
use super::{TileLack, TileNumber, TileStore};
use pilotage_base::bytes::ByteSource;
use pilotage_base::frames::{Geodetic, GroundRect, LocalFrame, wrap_pi};
use pilotage_raster::imagery::kept::RecentValues;
use pilotage_raster::raster::{Raster, Rgba, decode_picture_with_coverage};

/// Bytes of the header.
const HEADER: usize = 127;
/// Most bytes of an unpacked directory.
const LARGEST_DIRECTORY: u64 = 64 << 20;
/// Most bytes of a tile.
const LARGEST_TILE: u64 = 16 << 20;
/// Most steps from directory to directory; the specification makes two.
const DEEPEST_DIRECTORY: usize = 4;
/// Most bytes of the description; longer ones are passed over.
const LONGEST_METADATA: u64 = 1 << 20;
/// Bytes of leaf directories that are kept.
const DIRECTORIES: usize = 16 << 20;
/// First bytes of what gzip packs.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// Format of the tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TileFormat {
    /// PNG.
    Png,
    /// JPEG.
    Jpeg,
}

/// Why an archive cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PmTilesError {
    /// The first bytes are not those of an archive.
    #[error("{file}: not a PMTiles archive of version 3")]
    NotPmTiles {
        /// Name of the file.
        file: String,
    },
    /// The bytes could not be had.
    #[error("{file}, {place}: {cause}")]
    Read {
        /// Name of the file.
        file: String,
        /// Header, directory or tile.
        place: String,
        /// Error in words.
        cause: String,
    },
    /// The bytes contradict each other, or end too early.
    #[error("{file}, {place}: {cause}; the file is damaged or cut off, fetch it again")]
    Damaged {
        /// Name of the file.
        file: String,
        /// Header, directory or tile.
        place: String,
        /// Error at that place, in words.
        cause: String,
    },
    /// The archive is sound, but of a kind that is not read.
    #[error("{file}: {cause}")]
    Unsupported {
        /// Name of the file.
        file: String,
        /// Kind of the archive, and kinds that would be read instead.
        cause: String,
    },
}

/// An entry of a directory: a run of tiles with the same bytes, or (a run of zero) a directory.
#[derive(Clone, Copy, Debug)]
struct TileRun {
    id: u64,
    run: u64,
    offset: u64,
    length: u64,
}

/// An open archive.
pub struct PmTiles {
    source: Arc<dyn ByteSource>,
    root: Vec<TileRun>,
    leaves: RecentValues<u64, Vec<TileRun>>,
    leaf_offset: u64,
    data_offset: u64,
    is_packed: bool,
    /// Whether each tile is packed by gzip as well.
    has_packed_tiles: bool,
    format: TileFormat,
    zooms: (u8, u8),
    side: usize,
    /// South-west and north-east corner.
    corners: (Geodetic, Geodetic),
    /// Place that is shown first.
    centre: Geodetic,
    metadata: ArchiveMetadata,
}

impl PmTiles {
    /// Reads header and root directory.
    pub fn open(source: Arc<dyn ByteSource>) -> Result<Self, PmTilesError> {
        let file = source.name().to_owned();
        let not = || PmTilesError::NotPmTiles { file: file.clone() };
        if source.length() < HEADER as u64 {
            return Err(not());
        }
        let header = read(source.as_ref(), 0, HEADER as u64, "header")?;
        if header.get(..8) != Some(b"PMTiles\x03") {
            return Err(not());
        }
        let word = |at: usize| little(&header[at..at + 8]);
        let angle = |at: usize| {
            let bytes = [header[at], header[at + 1], header[at + 2], header[at + 3]];
            f64::from(i32::from_le_bytes(bytes)) / 1e7
        };
        let unsupported = |cause: String| PmTilesError::Unsupported {
            file: file.clone(),
            cause,
        };
        let is_packed = match header[97] {
            1 => false,
            2 => true,
            other => {
                return Err(unsupported(format!(
                    "directories packed by method {other}; none and gzip are read"
                )));
            }
        };
        // What a program does not know is mostly nothing.
        let has_packed_tiles = match header[98] {
            0 | 1 => false,
            2 => true,
            other => {
                let name = ["", "", "", "Brotli", "Zstandard"].get(usize::from(other));
                return Err(unsupported(format!(
                    "tiles packed by {} (method {other}); plain ones and those packed by gzip are read",
                    name.unwrap_or(&"an unknown method")
                )));
            }
        };
        let format = match header[99] {
            2 => TileFormat::Png,
            3 => TileFormat::Jpeg,
            other => {
                let name = ["unknown", "vector", "", "", "WebP", "AVIF"];
                let name = name.get(usize::from(other)).unwrap_or(&"unknown");
                return Err(unsupported(format!(
                    "{name} tiles (kind {other}); PNG and JPEG tiles are read"
                )));
            }
        };
        let zooms = (header[100], header[101]);
        if zooms.0 > zooms.1 || zooms.1 > super::number::DEEPEST {
            return Err(damaged(&file, "header", format!("zooms {zooms:?}")));
        }
        let root = read(source.as_ref(), word(8), word(16), "root directory")?;
        let root = unpack(&root, is_packed)
            .and_then(|bytes| entries(&bytes))
            .map_err(|cause| damaged(&file, "root directory", cause))?;
        let metadata = described(source.as_ref(), word(24), word(32), is_packed);
        let mut archive = Self {
            metadata,
            source,
            root,
            leaves: RecentValues::new(DIRECTORIES),
            leaf_offset: word(40),
            data_offset: word(56),
            is_packed,
            has_packed_tiles,
            format,
            zooms,
            side: 256,
            corners: (
                Geodetic::from_degrees(angle(106), angle(102), 0.0),
                Geodetic::from_degrees(angle(114), angle(110), 0.0),
            ),
            centre: Geodetic::from_degrees(angle(123), angle(119), 0.0),
        };
        // The header does not say how large the tiles are: the first one does.
        let first = archive.first_tile()?;
        if let Some(tile) = first.and_then(|bytes| decode_picture_with_coverage(&bytes).ok()) {
            archive.side = tile.width();
        }
        Ok(archive)
    }

    /// Format of the tiles.
    pub fn format(&self) -> TileFormat {
        self.format
    }

    /// Metadata of the archive.
    pub fn metadata(&self) -> &ArchiveMetadata {
        &self.metadata
    }

    /// South-west and north-east corner of the map.
    pub fn corners(&self) -> (Geodetic, Geodetic) {
        self.corners
    }

    /// Middle of the map, for the origin of a world frame.
    pub fn middle(&self) -> Geodetic {
        let (south_west, north_east) = self.corners;
        // One that goes over the date line has its west in the east.
        let across = north_east.longitude - south_west.longitude;
        let across = if across < 0.0 { across + TAU } else { across };
        Geodetic {
            latitude: 0.5 * (south_west.latitude + north_east.latitude),
            longitude: wrap_pi(south_west.longitude + 0.5 * across),
            height: 0.0,
        }
    }

    /// The place that the archive states as its centre, if it lies between its corners.
    pub fn centre(&self) -> Option<Geodetic> {
        let (south_west, north_east) = self.corners;
        let east_of_west = |longitude: f64| (longitude - south_west.longitude).rem_euclid(TAU);
        let width = east_of_west(north_east.longitude);
        // Bounds around the whole globe begin where they end.
        let is_within = width == 0.0 || east_of_west(self.centre.longitude) <= width;
        let latitudes = south_west.latitude..=north_east.latitude;
        // Who states none writes zeros.
        let is_stated = (self.centre.latitude, self.centre.longitude) != (0.0, 0.0);
        let is_within = is_within && latitudes.contains(&self.centre.latitude);
        (is_stated && is_within).then_some(self.centre)
    }

    /// The ground of the world frame `frame` that the map covers.
    pub fn area(&self, frame: &LocalFrame) -> Option<GroundRect> {
        let (a, b) = self.corners;
        let corners = [
            (a.latitude, a.longitude),
            (a.latitude, b.longitude),
            (b.latitude, a.longitude),
            (b.latitude, b.longitude),
        ];
        GroundRect::around(corners.map(|(latitude, longitude)| {
            frame.ground_from_geodetic(&Geodetic {
                latitude,
                longitude,
                height: 0.0,
            })
        }))
    }

    fn first_tile(&self) -> Result<Option<Vec<u8>>, PmTilesError> {
        let mut entry = self.root.first().copied();
        for _ in 0..DEEPEST_DIRECTORY {
            match entry {
                Some(leaf) if leaf.run == 0 => entry = self.leaf(&leaf)?.first().copied(),
                Some(tile) => return self.bytes_of(&tile).map(Some),
                None => return Ok(None),
            }
        }
        Ok(None)
    }

    fn leaf(&self, entry: &TileRun) -> Result<Arc<Vec<TileRun>>, PmTilesError> {
        let place = "leaf directory";
        self.leaves.get_or_make(entry.offset, || {
            let offset = self.leaf_offset.saturating_add(entry.offset);
            let bytes = read(self.source.as_ref(), offset, entry.length, place)?;
            let entries = unpack(&bytes, self.is_packed)
                .and_then(|bytes| entries(&bytes))
                .map_err(|cause| damaged(self.source.name(), place, cause))?;
            let size = entries.len() * size_of::<TileRun>();
            Ok((entries, size))
        })
    }

    fn bytes_of(&self, entry: &TileRun) -> Result<Vec<u8>, PmTilesError> {
        if entry.length > LARGEST_TILE {
            let cause = format!("{} bytes", entry.length);
            return Err(damaged(self.source.name(), "tile", cause));
        }
        let offset = self.data_offset.saturating_add(entry.offset);
        let bytes = read(self.source.as_ref(), offset, entry.length, "tile")?;
        // Some state a packing that their pictures do not have.
        if !(self.has_packed_tiles && bytes.starts_with(&GZIP)) {
            return Ok(bytes);
        }
        unpack(&bytes, true).map_err(|cause| damaged(self.source.name(), "tile", cause))
    }

    /// Bytes of a tile, unpacked, `None` if the map leaves it out.
    pub fn bytes(&self, tile: &TileNumber) -> Result<Option<Vec<u8>>, PmTilesError> {
        let id = tile.hilbert();
        let Some(mut entry) = find(&self.root, id) else {
            return Ok(None);
        };
        for _ in 0..DEEPEST_DIRECTORY {
            if entry.run > 0 {
                return self.bytes_of(&entry).map(Some);
            }
            match find(&self.leaf(&entry)?, id) {
                Some(next) => entry = next,
                None => return Ok(None),
            }
        }
        Err(damaged(
            self.source.name(),
            "leaf directory",
            "they lead from one to the other".to_owned(),
        ))
    }
}

impl TileStore for PmTiles {
    fn name(&self) -> &str {
        self.source.name()
    }

    fn zooms(&self) -> (u8, u8) {
        self.zooms
    }

    fn side(&self) -> usize {
        self.side
    }

    fn attribution(&self) -> Option<&str> {
        self.metadata.attribution.as_deref()
    }

    fn tile(&self, tile: &TileNumber) -> Result<Option<Raster<Rgba>>, TileLack> {
        let bytes = self.bytes(tile).map_err(|problem| match problem {
            PmTilesError::Read { .. } => TileLack::Unreachable(problem.to_string()),
            _ => TileLack::Unreadable(problem.to_string()),
        })?;
        let Some(bytes) = bytes else {
            return Ok(None);
        };
        let pixels = decode_picture_with_coverage(&bytes);
        pixels.map(Some).map_err(|cause| {
            let TileNumber { zoom, x, y } = tile;
            let place = format!("tile {zoom}/{x}/{y}");
            let problem = damaged(self.source.name(), &place, cause.to_string());
            TileLack::Unreadable(problem.to_string())
        })
    }
}

fn damaged(file: &str, place: &str, cause: String) -> PmTilesError {
    PmTilesError::Damaged {
        file: file.to_owned(),
        place: place.to_owned(),
        cause,
    }
}

/// The description at `offset`; nothing if it cannot be read, for the tiles can be shown without it.
fn described(
    source: &dyn ByteSource,
    offset: u64,
    length: u64,
    is_packed: bool,
) -> ArchiveMetadata {
    if length > LONGEST_METADATA {
        return ArchiveMetadata::default();
    }
    let bytes = read(source, offset, length, "description").ok();
    let text = bytes.and_then(|bytes| unpack(&bytes, is_packed).ok());
    text.map_or_else(ArchiveMetadata::default, |text| {
        ArchiveMetadata::read(&text)
    })
}

fn read(
    source: &dyn ByteSource,
    offset: u64,
    length: u64,
    place: &str,
) -> Result<Vec<u8>, PmTilesError> {
    let end = offset.checked_add(length);
    if end.is_none_or(|end| end > source.length()) || length > LARGEST_DIRECTORY {
        let cause = format!("{length} bytes at byte {offset} lie beyond the end of the file");
        return Err(damaged(source.name(), place, cause));
    }
    let bytes = source
        .read(offset, length as usize)
        .map_err(|cause| PmTilesError::Read {
            file: source.name().to_owned(),
            place: place.to_owned(),
            cause,
        })?;
    if bytes.len() as u64 == length {
        Ok(bytes)
    } else {
        Err(damaged(source.name(), place, "it came cut off".to_owned()))
    }
}

fn little(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .rev()
        .fold(0, |sum, b| sum << 8 | u64::from(*b))
}

fn unpack(bytes: &[u8], is_packed: bool) -> Result<Vec<u8>, String> {
    if !is_packed {
        return Ok(bytes.to_vec());
    }
    let mut out = Vec::new();
    GzDecoder::new(bytes)
        .take(LARGEST_DIRECTORY)
        .read_to_end(&mut out)
        .map_err(|e| format!("gzip: {e}"))?;
    Ok(out)
}

/// The entry that holds `id`: the last that begins at or before it.
fn find(entries: &[TileRun], id: u64) -> Option<TileRun> {
    let after = entries.partition_point(|entry| entry.id <= id);
    let entry = *entries.get(after.checked_sub(1)?)?;
    let holds = entry.run == 0 || id - entry.id < entry.run;
    holds.then_some(entry)
}

/// Reads a directory: a count, then all ids as differences, all runs, all lengths, all offsets, as
/// numbers of seven bits a byte. An offset of zero means "behind the one before".
fn entries(bytes: &[u8]) -> Result<Vec<TileRun>, String> {
    let mut rest = bytes;
    let mut next = || -> Result<u64, String> {
        let mut value = 0_u64;
        for shift in (0..64).step_by(7) {
            let (byte, after) = rest.split_first().ok_or("the directory ends early")?;
            rest = after;
            value |= u64::from(byte & 0x7f) << shift;
            if byte & 0x80 == 0 {
                return Ok(value);
            }
        }
        Err("a number of more than 64 bits".to_owned())
    };
    let count = next()?;
    // Every entry takes at least four bytes.
    if count > bytes.len() as u64 / 4 {
        return Err(format!("{count} entries in {} bytes", bytes.len()));
    }
    let mut entries = Vec::with_capacity(count as usize);
    let mut id = 0_u64;
    for _ in 0..count {
        id = id.checked_add(next()?).ok_or("a tile beyond the last")?;
        entries.push(TileRun {
            id,
            run: 0,
            offset: 0,
            length: 0,
        });
    }
    for entry in &mut entries {
        entry.run = next()?;
    }
    for entry in &mut entries {
        entry.length = next()?;
    }
    let mut end = 0_u64;
    for (index, entry) in entries.iter_mut().enumerate() {
        entry.offset = match next()? {
            0 if index > 0 => end,
            0 => return Err("the first entry lies behind none".to_owned()),
            offset => offset - 1,
        };
        end = entry.offset.saturating_add(entry.length);
    }
    Ok(entries)
}
