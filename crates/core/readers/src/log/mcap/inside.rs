//! From record to record through a chunk.

use super::contents::McapContents;
use super::record::{CHANNEL, FRAME, MESSAGE, Record, SCHEMA, frame, parse, whole_length};
use super::search::{followed, next_inside};
use crate::log::Log;

/// The records of a chunk.
pub(super) struct ChunkRecords<'a> {
    pub records: &'a [u8],
    /// Place of the first in the file, where they are not packed.
    pub offset: Option<u64>,
    /// Whether their checksum is right, so that nothing of them has to be doubted.
    pub is_sound: bool,
}

impl ChunkRecords<'_> {
    /// Takes all records; returns the number of bytes that make no sense. What is not packed is accounted
    /// for in the log's report.
    pub fn walk(&self, contents: &mut McapContents, log: &mut Log) -> usize {
        let mut nonsense = 0;
        let mut place = 0;
        while place < self.records.len() {
            let rest = &self.records[place..];
            let (length, wrong) = match self.next(rest) {
                Ok((length, record)) => (length, contents.take(record, log).err()),
                Err(cause) => (1 + next_inside(contents, &rest[1..]), Some(cause)),
            };
            match (wrong, self.offset) {
                (Some(cause), Some(offset)) => {
                    log.report.skip(offset + place as u64, length as u64, cause);
                }
                (None, Some(_)) => log.report.used_bytes += length as u64,
                _ => {}
            }
            if wrong.is_some() {
                nonsense += length;
            }
            place += length;
        }
        nonsense
    }

    fn next<'b>(&self, rest: &'b [u8]) -> Result<(usize, Record<'b>), &'static str> {
        const CUT: &str = "a record reaches beyond the end of its chunk";
        let (kind, length) = frame(rest).ok_or(CUT)?;
        if !matches!(kind, SCHEMA | CHANNEL | MESSAGE) {
            return Err("a record that has no place in a chunk");
        }
        let length = whole_length(length).ok_or(CUT)?;
        let record = parse(kind, rest.get(FRAME..length).ok_or(CUT)?)?;
        let is_believed = self.is_sound || followed(&rest[length..], true) == Some(true);
        if is_believed {
            Ok((length, record))
        } else {
            Err("no record follows")
        }
    }
}
