//! Messages found in a stream of bytes.

use super::super::{Log, LogReader};
use super::contents::{Announced, DataflashContents, UNANNOUNCED};
use super::format::{FORMAT, HEADER, MessageFormat};

/// The bytes that every message begins with.
const MARKS: [u8; 2] = [0xa3, 0x95];
/// Bytes with which every question about a place is answered: a message, one that begins within it, and
/// the marks after that.
const ENOUGH: usize = 512;

const NOISE: &str = "no message begins here";
const INTERRUPTED: &str = "a message that another one interrupts";
const CUT_OFF: &str = "the file ends within a message";

/// Reads `ArduPilot`'s dataflash logs, binary.
pub struct DataflashReader {
    contents: DataflashContents,
    /// Bytes that wait for more.
    waiting: Vec<u8>,
    /// Place in the file of the first byte that waits.
    offset: u64,
    /// Whether a message ended right before.
    is_in_step: bool,
    /// Why bytes are skipped at the moment.
    skipping: Option<&'static str>,
}

/// Next step of the reader.
enum BinaryStep {
    /// Wait for more bytes.
    Wait,
    /// Take a message of so many bytes.
    Take(usize),
    /// Take another length for messages of that number.
    Measure(u8),
    /// Leave out so many bytes.
    Skip(usize, &'static str),
}

/// Answer to whether a message stands at a place.
#[derive(PartialEq)]
enum FoundMessage {
    Yes,
    No,
    /// That takes more bytes to say.
    Unknown,
}

/// Whether a file that begins so is such a log: somewhere near its beginning a kind of message is announced.
pub fn begins(head: &[u8]) -> bool {
    let starts = head.windows(HEADER).enumerate();
    let mut announcements = starts.filter(|(_, w)| **w == [MARKS[0], MARKS[1], FORMAT]);
    announcements.any(|(at, _)| {
        let format = MessageFormat::read(&head[at + HEADER..]);
        format.is_ok_and(|format| format.oddity().is_none())
    })
}

impl DataflashReader {
    /// A reader at the beginning of a file.
    pub fn new() -> Self {
        Self {
            contents: DataflashContents::new(Announced::ByRows),
            waiting: Vec::new(),
            offset: 0,
            is_in_step: true,
            skipping: None,
        }
    }

    /// Reads what can be read of `bytes`, and returns how many bytes that were.
    fn read(&mut self, bytes: &[u8], is_last: bool, log: &mut Log) -> usize {
        let mut at = 0;
        loop {
            let rest = &bytes[at..];
            let (length, cause) = match self.step(rest, is_last) {
                BinaryStep::Wait => break,
                BinaryStep::Take(length) => {
                    match self.contents.row(rest[2], &rest[HEADER..length], log) {
                        Ok(()) => {
                            log.report.message(length);
                            self.skipping = None;
                            self.is_in_step = true;
                            at += length;
                            continue;
                        }
                        Err(cause) => (length, cause),
                    }
                }
                BinaryStep::Measure(number) => {
                    self.contents.take_other_length(number, log);
                    continue;
                }
                BinaryStep::Skip(length, cause) => {
                    self.is_in_step = false;
                    (length, cause)
                }
            };
            let cause = *self.skipping.get_or_insert(cause);
            log.report
                .skip(self.offset + at as u64, length as u64, cause);
            at += length;
        }
        self.offset += at as u64;
        at
    }

    #[inline]
    fn step(&self, rest: &[u8], is_last: bool) -> BinaryStep {
        let length = match *rest {
            [] => return BinaryStep::Wait,
            [a, b, number, ..] if [a, b] == MARKS => match self.contents.length(number) {
                Some(length) => length,
                None => return BinaryStep::Skip(MARKS.len(), UNANNOUNCED),
            },
            [_] | [_, _] if MARKS.starts_with(rest) => {
                return if is_last {
                    BinaryStep::Skip(rest.len(), CUT_OFF)
                } else {
                    BinaryStep::Wait
                };
            }
            _ => {
                let next = rest[1..].iter().position(|b| *b == MARKS[0]);
                return BinaryStep::Skip(next.map_or(rest.len(), |n| n + 1), NOISE);
            }
        };
        match Self::ends_before_another(rest, length, is_last) {
            FoundMessage::Yes => BinaryStep::Take(length),
            FoundMessage::Unknown => BinaryStep::Wait,
            FoundMessage::No if self.has_other_length(rest, is_last) => {
                BinaryStep::Measure(rest[2])
            }
            FoundMessage::No => self.doubtful(rest, length, is_last),
        }
    }

    /// Tells whether the message is there as a whole and followed by another one, or by the end of the file.
    #[inline]
    fn ends_before_another(rest: &[u8], length: usize, is_last: bool) -> FoundMessage {
        let is = |yes| {
            if yes {
                FoundMessage::Yes
            } else {
                FoundMessage::No
            }
        };
        match rest.get(length..) {
            Some([a, b, ..]) => is([*a, *b] == MARKS),
            _ if !is_last => FoundMessage::Unknown,
            Some([a]) => is(*a == MARKS[0]),
            Some(_) => FoundMessage::Yes,
            None => FoundMessage::No,
        }
    }

    /// Tells whether the message is followed by another one if it is as long as its fields, and not as announced.
    fn has_other_length(&self, rest: &[u8], is_last: bool) -> bool {
        let other = self.contents.other_length(rest[2]);
        other.is_some_and(|length| {
            rest.len() > length + 1
                && Self::ends_before_another(rest, length, is_last) == FoundMessage::Yes
        })
    }

    /// A message that no other one follows. After another message it counts, unless a whole one begins within
    /// it; in the midst of noise its marks may be chance.
    fn doubtful(&self, rest: &[u8], length: usize, is_last: bool) -> BinaryStep {
        if !self.is_in_step {
            return BinaryStep::Skip(MARKS.len(), NOISE);
        }
        if rest.len() < ENOUGH && !is_last {
            return BinaryStep::Wait;
        }
        let within = rest.windows(HEADER).enumerate().take(length).skip(1);
        for (at, header) in within {
            if header[..2] == MARKS
                && let Some(length) = self.contents.length(header[2])
                && Self::ends_before_another(&rest[at..], length, is_last) == FoundMessage::Yes
            {
                return BinaryStep::Skip(at, INTERRUPTED);
            }
        }
        if rest.len() < length {
            return BinaryStep::Skip(rest.len(), CUT_OFF);
        }
        BinaryStep::Take(length)
    }
}

impl Default for DataflashReader {
    fn default() -> Self {
        Self::new()
    }
}

impl LogReader for DataflashReader {
    fn feed(&mut self, bytes: &[u8], log: &mut Log) {
        log.report.bytes += bytes.len() as u64;
        let mut bytes = bytes;
        while !self.waiting.is_empty() && !bytes.is_empty() {
            let mut joined = std::mem::take(&mut self.waiting);
            let old = joined.len();
            let added = bytes.len().min(ENOUGH);
            joined.extend_from_slice(&bytes[..added]);
            let used = self.read(&joined, false, log);
            if used >= old {
                bytes = &bytes[used - old..];
            } else {
                bytes = &bytes[added..];
                joined.drain(..used);
                self.waiting = joined;
            }
        }
        if !bytes.is_empty() {
            let used = self.read(bytes, false, log);
            self.waiting.extend_from_slice(&bytes[used..]);
        }
        self.contents.settle(log);
    }

    fn finish(&mut self, log: &mut Log) {
        let rest = std::mem::take(&mut self.waiting);
        self.read(&rest, true, log);
        self.contents.finish(log);
    }
}
