//! Chunks: records together, often packed.

use std::borrow::Cow;
use std::io::Read;

use super::bytes::Cursor;
use super::record::FRAME;
use super::zstandard;

/// Longest name of a way of packing, in bytes.
const LONGEST_NAME: u32 = 64;
/// Most bytes that a chunk may be unpacked to, whatever it says: so many, and so many for each packed one.
const UNPACKED: u64 = 16 << 20;
const UNPACKED_PER_BYTE: u64 = 256;

/// Compression of the records of a chunk.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Packing {
    Not,
    Lz4,
    Zstandard,
    Unknown(String),
}

/// Header of a chunk, before its records.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ChunkHead {
    pub packing: Packing,
    /// Bytes of the whole record before the packed ones.
    pub length: usize,
    /// Bytes of the packed records.
    pub packed: usize,
    /// Bytes of the records unpacked.
    pub unpacked: u64,
    /// CRC-32 of the records unpacked; zero if nobody computed it.
    pub checksum: u32,
}

/// The head of the chunk that `bytes` begin with; `None` if more are needed to tell. The lengths in it have
/// to agree, which hardly any accident brings about.
pub(super) fn head(bytes: &[u8]) -> Option<Result<ChunkHead, &'static str>> {
    const WRONG: &str = "a chunk contradicts itself";
    let mut bytes = Cursor::new(bytes);
    bytes.byte()?;
    let contents = bytes.long()?;
    bytes.take(8 + 8)?;
    let unpacked = bytes.long()?;
    let checksum = bytes.word()?;
    let name = bytes.word()?;
    if name > LONGEST_NAME {
        return Some(Err(WRONG));
    }
    let name_length = name as usize;
    let name = bytes.take(name_length)?;
    let packed = bytes.long()?;
    let before = 8 + 8 + 8 + 4 + 4 + name_length + 8;
    let packing = match name {
        b"" => Packing::Not,
        b"lz4" => Packing::Lz4,
        b"zstd" => Packing::Zstandard,
        _ => match str::from_utf8(name) {
            Ok(name) => Packing::Unknown(name.to_owned()),
            Err(_) => return Some(Err(WRONG)),
        },
    };
    let fits = packed.checked_add(before as u64) == Some(contents)
        && (packing != Packing::Not || packed == unpacked);
    let packed = usize::try_from(packed).ok().filter(|_| fits);
    // On machines of 32 bits no chunk reaches beyond what can be counted.
    let packed = packed.filter(|packed| packed.checked_add(FRAME + before).is_some());
    Some(packed.ok_or(WRONG).map(|packed| ChunkHead {
        packing,
        length: FRAME + before,
        packed,
        unpacked,
        checksum,
    }))
}

/// Records as they were before they were packed, as far as that goes, and why it goes no further.
pub(super) fn unpack<'a>(
    head: &ChunkHead,
    packed: &'a [u8],
) -> (Cow<'a, [u8]>, Option<&'static str>) {
    let most = UNPACKED + UNPACKED_PER_BYTE * packed.len() as u64;
    if head.unpacked > most {
        let bomb = "a chunk says that it unpacks to far more than it has";
        return (Cow::Borrowed(&[]), Some(bomb));
    }
    let (unpacked, is_good) = match head.packing {
        Packing::Not => return (Cow::Borrowed(packed), None),
        Packing::Lz4 => lz4(packed, head.unpacked),
        Packing::Zstandard => zstandard::unpack(packed, head.unpacked),
        Packing::Unknown(_) => (Vec::new(), false),
    };
    let trouble = if !is_good {
        Some("a chunk cannot be unpacked, or not all of it")
    } else if unpacked.len() as u64 == head.unpacked {
        None
    } else {
        Some("a chunk does not unpack to what it says")
    };
    (Cow::Owned(unpacked), trouble)
}

/// Unpacks LZ4: at most one byte more than `most`, and whether that is all of it.
fn lz4(packed: &[u8], most: u64) -> (Vec<u8>, bool) {
    let mut unpacked = Vec::new();
    let decoder = lz4_flex::frame::FrameDecoder::new(packed);
    let read = decoder.take(most + 1).read_to_end(&mut unpacked);
    (unpacked, read.is_ok())
}
