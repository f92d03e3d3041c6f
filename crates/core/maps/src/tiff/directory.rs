//! Directories: the tags of every image in the file.

use std::collections::BTreeMap;

use super::error::Blame;
use super::{Tag, TiffError};
use pilotage_base::bytes::ByteSource;
use pilotage_base::tiff_entry::{TiffEntry, size_of_kind, unsigned};

/// Most directories that are followed.
const MOST_DIRECTORIES: usize = 64;
/// Most tags of a directory.
const MOST_TAGS: u64 = 4096;
/// Most bytes of the values of a tag.
const LARGEST_VALUES: u64 = 64 << 20;
/// Bytes that are fetched at once while directories are read: they mostly lie together.
const BLOCK: u64 = 1 << 16;

/// Reads small pieces of a source through blocks, so that a slow source is asked rarely.
pub(super) struct BlockReader<'a> {
    source: &'a dyn ByteSource,
    is_little_endian: bool,
    is_big: bool,
    block: (u64, Vec<u8>),
}

/// Entry of one tag: its kind, and its values.
#[derive(Clone, Debug)]
struct TagEntry {
    kind: u16,
    values: Vec<u8>,
}

/// The tags of one image.
#[derive(Clone, Debug)]
pub struct Directory {
    file: String,
    length: u64,
    is_little_endian: bool,
    entries: BTreeMap<u16, TagEntry>,
}

impl<'a> BlockReader<'a> {
    /// Reads the header; gives the offset of the first directory as well.
    pub fn open(source: &'a dyn ByteSource) -> Result<(Self, u64), TiffError> {
        let not_tiff = || TiffError::NotTiff {
            file: source.name().to_owned(),
        };
        let mut reader = Self {
            source,
            is_little_endian: true,
            is_big: false,
            block: (0, Vec::new()),
        };
        if source.length() < 8 {
            return Err(not_tiff());
        }
        let head = reader.bytes(0, 8, "header")?;
        reader.is_little_endian = match &head[..2] {
            b"II" => true,
            b"MM" => false,
            _ => return Err(not_tiff()),
        };
        let number = |bytes: &[u8]| unsigned(bytes, reader.is_little_endian);
        match number(&head[2..4]) {
            42 => {
                let first = number(&head[4..8]);
                Ok((reader, first))
            }
            43 if number(&head[4..6]) == 8 => {
                reader.is_big = true;
                let first = reader.number(8, 8, "header")?;
                Ok((reader, first))
            }
            _ => Err(not_tiff()),
        }
    }

    fn blame<'b>(&'b self, place: &'b str) -> Blame<'b> {
        Blame {
            file: self.source.name(),
            place,
        }
    }

    /// `length` bytes at `offset`.
    fn bytes(&mut self, offset: u64, length: u64, place: &str) -> Result<Vec<u8>, TiffError> {
        let size = self.source.length();
        let end = offset.checked_add(length).filter(|end| *end <= size);
        let Some(end) = end else {
            return Err(self.blame(place).damaged(format!(
                "{length} bytes at byte {offset} would lie beyond the end of the file at {size}"
            )));
        };
        if length > BLOCK {
            return fetch(self.source, offset, length)
                .map_err(|cause| self.blame(place).read(cause));
        }
        let held =
            |(start, block): &(u64, Vec<u8>)| offset >= *start && end <= start + block.len() as u64;
        if !held(&self.block) {
            let start = offset / 4096 * 4096;
            let block_length = (BLOCK + 4096).min(size - start);
            let block = fetch(self.source, start, block_length)
                .map_err(|cause| self.blame(place).read(cause))?;
            self.block = (start, block);
        }
        let from = (offset - self.block.0) as usize;
        Ok(self.block.1[from..from + length as usize].to_vec())
    }

    fn number(&mut self, offset: u64, length: u64, place: &str) -> Result<u64, TiffError> {
        let bytes = self.bytes(offset, length, place)?;
        Ok(unsigned(&bytes, self.is_little_endian))
    }

    /// All directories of the chain that begins at `first`.
    pub fn directories(&mut self, first: u64) -> Result<Vec<Directory>, TiffError> {
        let mut directories = Vec::new();
        let mut visited = Vec::new();
        let mut offset = first;
        while offset != 0 && directories.len() < MOST_DIRECTORIES {
            let place = format!("directory {} at byte {offset}", directories.len());
            if visited.contains(&offset) {
                return Err(self
                    .blame(&place)
                    .damaged("the directories go round in a circle"));
            }
            visited.push(offset);
            let (directory, next) = self.directory(offset, &place)?;
            directories.push(directory);
            offset = next;
        }
        Ok(directories)
    }

    fn directory(&mut self, offset: u64, place: &str) -> Result<(Directory, u64), TiffError> {
        let (head, entry, word) = if self.is_big { (8, 20, 8) } else { (2, 12, 4) };
        let count = self.number(offset, head, place)?;
        if count > MOST_TAGS {
            return Err(self.blame(place).damaged(format!("it claims {count} tags")));
        }
        let table = self.bytes(offset + head, count * entry + word, place)?;
        let mut entries = BTreeMap::new();
        for bytes in table.chunks_exact(entry as usize).take(count as usize) {
            let read = TiffEntry::read(bytes, self.is_little_endian);
            if let Some(values) = self.values(&read)? {
                // The first of several is the one that counts.
                let kind = read.kind;
                entries.entry(read.tag).or_insert(TagEntry { kind, values });
            }
        }
        let next = &table[(count * entry) as usize..];
        let directory = Directory {
            file: self.source.name().to_owned(),
            length: self.source.length(),
            is_little_endian: self.is_little_endian,
            entries,
        };
        Ok((directory, unsigned(next, self.is_little_endian)))
    }

    /// The bytes of a tag's values; `None` for tags that are of no use here.
    fn values(&mut self, entry: &TiffEntry<'_>) -> Result<Option<Vec<u8>>, TiffError> {
        let TiffEntry {
            tag, count, inline, ..
        } = *entry;
        let place = format!("tag {tag}");
        let Some(length) = entry.length().filter(|_| Tag::is_read(tag)) else {
            return Ok(None);
        };
        if length <= inline.len() as u64 {
            return Ok(Some(inline[..length as usize].to_vec()));
        }
        if length > LARGEST_VALUES {
            return Err(self
                .blame(&place)
                .damaged(format!("it claims {count} values")));
        }
        let offset = unsigned(inline, self.is_little_endian);
        self.bytes(offset, length, &place).map(Some)
    }
}

fn fetch(source: &dyn ByteSource, offset: u64, length: u64) -> Result<Vec<u8>, String> {
    let bytes = source.read(offset, length as usize)?;
    if bytes.len() as u64 == length {
        Ok(bytes)
    } else {
        Err(format!(
            "{} bytes came of {length} at byte {offset}",
            bytes.len()
        ))
    }
}

impl Directory {
    /// Bytes of the file.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// Whether numbers begin with the least significant byte.
    pub fn is_little_endian(&self) -> bool {
        self.is_little_endian
    }

    fn entry(&self, tag: Tag) -> Option<&TagEntry> {
        self.entries.get(&(tag as u16))
    }

    /// Whole numbers of a tag, empty if it is absent.
    pub fn numbers(&self, tag: Tag) -> Result<Vec<u64>, TiffError> {
        let Some(entry) = self.entry(tag) else {
            return Ok(Vec::new());
        };
        match entry.kind {
            1 | 3 | 4 | 7 | 13 | 16 | 18 => {
                let size = size_of_kind(entry.kind).unwrap_or(1) as usize;
                let values = entry.values.chunks_exact(size);
                Ok(values.map(|v| unsigned(v, self.is_little_endian)).collect())
            }
            kind => Err(self.blame(&tag.name()).damaged(format!(
                "it has values of type {kind} where whole numbers belong"
            ))),
        }
    }

    /// The first whole number of a tag, `None` if it is absent.
    pub fn number(&self, tag: Tag) -> Result<Option<u64>, TiffError> {
        Ok(self.numbers(tag)?.first().copied())
    }

    /// Real numbers of a tag, empty if it is absent.
    pub fn reals(&self, tag: Tag) -> Result<Vec<f64>, TiffError> {
        let Some(entry) = self.entry(tag) else {
            return Ok(Vec::new());
        };
        let bits = |v: &[u8]| unsigned(v, self.is_little_endian);
        match entry.kind {
            12 => Ok((entry.values.chunks_exact(8))
                .map(|v| f64::from_bits(bits(v)))
                .collect()),
            11 => Ok((entry.values.chunks_exact(4))
                .map(|v| f64::from(f32::from_bits(bits(v) as u32)))
                .collect()),
            _ => Ok(self.numbers(tag)?.iter().map(|v| *v as f64).collect()),
        }
    }

    /// Text of a tag without the zero at its end, `None` if it is absent.
    pub fn text(&self, tag: Tag) -> Option<String> {
        let values = &self.entry(tag)?.values;
        let text = String::from_utf8_lossy(values);
        Some(text.trim_end_matches('\0').to_owned())
    }

    /// Bytes of a tag, empty if it is absent.
    pub fn bytes(&self, tag: Tag) -> Vec<u8> {
        self.entry(tag)
            .map_or_else(Vec::new, |entry| entry.values.clone())
    }

    /// An error that names this file and `place`.
    pub(crate) fn blame<'a>(&'a self, place: &'a str) -> Blame<'a> {
        Blame {
            file: &self.file,
            place,
        }
    }
}
