//! Records: a kind, a length, and what fills that length exactly.

use super::bytes::Cursor;

/// Bytes of a record before its contents: kind and length.
pub(super) const FRAME: usize = 9;
/// Bytes that the contents of a message have before what it says.
pub(super) const MESSAGE_HEAD: usize = 22;
/// Longest record, in bytes, but for those that are taken piece by piece.
const LONGEST: u64 = 1 << 30;

pub(super) const HEADER: u8 = 0x01;
pub(super) const FOOTER: u8 = 0x02;
pub(super) const SCHEMA: u8 = 0x03;
pub(super) const CHANNEL: u8 = 0x04;
pub(super) const MESSAGE: u8 = 0x05;
pub(super) const CHUNK: u8 = 0x06;
const MESSAGE_INDEX: u8 = 0x07;
const CHUNK_INDEX: u8 = 0x08;
pub(super) const ATTACHMENT: u8 = 0x09;
const ATTACHMENT_INDEX: u8 = 0x0a;
const STATISTICS: u8 = 0x0b;
const METADATA: u8 = 0x0c;
const METADATA_INDEX: u8 = 0x0d;
const SUMMARY_OFFSET: u8 = 0x0e;
pub(super) const DATA_END: u8 = 0x0f;

/// A message, still packed as its schema says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct McapMessage<'a> {
    pub channel: u16,
    /// When it was logged, nanoseconds.
    pub logged: u64,
    /// When it was published, nanoseconds.
    pub published: u64,
    pub data: &'a [u8],
}

/// Contents of a record.
#[derive(Debug, PartialEq)]
pub(super) enum Record<'a> {
    Header {
        profile: &'a str,
        library: &'a str,
    },
    Footer {
        /// First byte of the summary in the file, zero without one.
        summary: u64,
        checksum: u32,
    },
    Schema {
        number: u16,
        name: &'a str,
        encoding: &'a str,
        data: &'a [u8],
    },
    Channel {
        number: u16,
        schema: u16,
        topic: &'a str,
        encoding: &'a str,
    },
    Message(McapMessage<'a>),
    Statistics {
        messages: u64,
    },
    Metadata {
        name: &'a str,
        pairs: Vec<(&'a str, &'a str)>,
    },
    DataEnd {
        checksum: u32,
    },
    /// It tells where others are, which whoever reads all of them need not know.
    Index,
}

/// Kind and length of the contents of the record that `bytes` begin with; `None` if more are needed.
pub(super) fn frame(bytes: &[u8]) -> Option<(u8, u64)> {
    let mut bytes = Cursor::new(bytes);
    Some((bytes.byte()?, bytes.long()?))
}

/// Length of a whole record whose contents have that length; `None` if no record is so long.
pub(super) fn whole_length(contents: u64) -> Option<usize> {
    let length = usize::try_from(contents).ok()?;
    (contents <= LONGEST).then(|| FRAME + length)
}

/// Whether a kind is one that the format defines.
pub(super) fn is_known(kind: u8) -> bool {
    (HEADER..=DATA_END).contains(&kind)
}

/// Whether a record may begin here; `None` if more bytes are needed.
pub(super) fn may_begin(bytes: &[u8]) -> Option<bool> {
    let kind = *bytes.first()?;
    if !is_known(kind) {
        return Some(false);
    }
    let (_, length) = frame(bytes)?;
    let shortest = match kind {
        MESSAGE => MESSAGE_HEAD as u64,
        FOOTER => 20,
        DATA_END => 4,
        _ => 2,
    };
    let is_taken_by_pieces = matches!(kind, CHUNK | ATTACHMENT);
    Some(length >= shortest && (length <= LONGEST || is_taken_by_pieces && length < 1 << 48))
}

/// Parses a record of that kind with these contents. The error says why it is none.
pub(super) fn parse(kind: u8, contents: &[u8]) -> Result<Record<'_>, &'static str> {
    let mut bytes = Cursor::new(contents);
    let record = match kind {
        HEADER => header(&mut bytes),
        FOOTER => footer(&mut bytes),
        SCHEMA => schema(&mut bytes),
        CHANNEL => channel(&mut bytes),
        MESSAGE => message(&mut bytes),
        STATISTICS => statistics(&mut bytes),
        METADATA => metadata(&mut bytes),
        DATA_END => bytes.word().map(|checksum| Record::DataEnd { checksum }),
        MESSAGE_INDEX | CHUNK_INDEX | ATTACHMENT_INDEX | METADATA_INDEX | SUMMARY_OFFSET => {
            index(kind, &mut bytes).map(|()| Record::Index)
        }
        _ => return Err("a kind of record that is not known"),
    };
    record
        .filter(|_| bytes.is_over())
        .ok_or("a record does not fill its length")
}

fn header<'a>(bytes: &mut Cursor<'a>) -> Option<Record<'a>> {
    Some(Record::Header {
        profile: bytes.text()?,
        library: bytes.text()?,
    })
}

fn footer<'a>(bytes: &mut Cursor<'a>) -> Option<Record<'a>> {
    let summary = bytes.long()?;
    bytes.long()?;
    let checksum = bytes.word()?;
    Some(Record::Footer { summary, checksum })
}

fn schema<'a>(bytes: &mut Cursor<'a>) -> Option<Record<'a>> {
    Some(Record::Schema {
        number: bytes.short()?,
        name: bytes.text()?,
        encoding: bytes.text()?,
        data: bytes.counted()?,
    })
}

fn channel<'a>(bytes: &mut Cursor<'a>) -> Option<Record<'a>> {
    let channel = Record::Channel {
        number: bytes.short()?,
        schema: bytes.short()?,
        topic: bytes.text()?,
        encoding: bytes.text()?,
    };
    bytes.pairs()?;
    Some(channel)
}

fn message<'a>(bytes: &mut Cursor<'a>) -> Option<Record<'a>> {
    let channel = bytes.short()?;
    bytes.word()?;
    let message = McapMessage {
        channel,
        logged: bytes.long()?,
        published: bytes.long()?,
        data: bytes.rest(),
    };
    bytes.take(message.data.len())?;
    Some(Record::Message(message))
}

fn statistics<'a>(bytes: &mut Cursor<'a>) -> Option<Record<'a>> {
    let messages = bytes.long()?;
    // Numbers of schemas, channels, attachments, metadata and chunks, first and last time.
    bytes.take(2 + 4 + 4 + 4 + 4 + 8 + 8)?;
    let counts = bytes.counted()?;
    (counts.len() % 10 == 0).then_some(Record::Statistics { messages })
}

fn metadata<'a>(bytes: &mut Cursor<'a>) -> Option<Record<'a>> {
    Some(Record::Metadata {
        name: bytes.text()?,
        pairs: bytes.pairs()?,
    })
}

fn index(kind: u8, bytes: &mut Cursor) -> Option<()> {
    match kind {
        MESSAGE_INDEX => {
            bytes.short()?;
            (bytes.counted()?.len() % 16 == 0).then_some(())
        }
        CHUNK_INDEX => {
            bytes.take(8 + 8 + 8 + 8)?;
            let offsets = bytes.counted()?;
            bytes.take(8)?;
            bytes.text()?;
            bytes.take(8 + 8)?;
            (offsets.len() % 10 == 0).then_some(())
        }
        ATTACHMENT_INDEX => {
            bytes.take(8 + 8 + 8 + 8 + 8)?;
            bytes.text()?;
            bytes.text().map(|_| ())
        }
        METADATA_INDEX => {
            bytes.take(8 + 8)?;
            bytes.text().map(|_| ())
        }
        _ => bytes.take(1 + 8 + 8).map(|_| ()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_must_fill_its_length() {
        let header = [2, 0, 0, 0, b'r', b'2', 1, 0, 0, 0, b'x'];
        let (profile, library) = ("r2", "x");
        let record = Ok(Record::Header { profile, library });
        assert_eq!(parse(HEADER, &header), record);
        assert!(parse(HEADER, &header[..10]).is_err());
        assert!(parse(HEADER, &[&header[..], &[0]].concat()).is_err());
        assert!(parse(0x10, &[]).is_err());
    }

    #[test]
    fn no_record_is_as_long_as_its_length_can_say() {
        assert_eq!(whole_length(4), Some(FRAME + 4));
        assert_eq!(whole_length(LONGEST + 1), None);
        assert_eq!(whole_length(u64::MAX), None);
    }

    #[test]
    fn a_message_is_all_that_follows_its_times() {
        let contents = [&[7, 0, 1, 0, 0, 0][..], &[2; 8], &[3; 8], b"data"].concat();
        let message = McapMessage {
            channel: 7,
            logged: 0x0202_0202_0202_0202,
            published: 0x0303_0303_0303_0303,
            data: b"data",
        };
        assert_eq!(parse(MESSAGE, &contents), Ok(Record::Message(message)));
        assert!(parse(MESSAGE, &contents[..21]).is_err());
    }

    #[test]
    fn a_length_beyond_all_reason_begins_no_record() {
        let frame = |kind: u8, length: u64| [&[kind][..], &length.to_le_bytes()].concat();
        assert_eq!(may_begin(&frame(MESSAGE, 30)), Some(true));
        assert_eq!(may_begin(&frame(MESSAGE, 21)), Some(false));
        assert_eq!(may_begin(&frame(MESSAGE, 1 << 40)), Some(false));
        assert_eq!(may_begin(&frame(ATTACHMENT, 1 << 40)), Some(true));
        assert_eq!(may_begin(&frame(0, 30)), Some(false));
        assert_eq!(may_begin(&frame(MESSAGE, 30)[..5]), None);
    }
}
