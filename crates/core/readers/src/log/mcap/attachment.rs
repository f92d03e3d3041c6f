//! A file within the file.

use crc32fast::Hasher;

use super::bytes::Cursor;
use super::record::FRAME;

/// Longest name and media type of an attachment, in bytes.
const LONGEST_NAME: usize = 1 << 12;

/// A file within the file, of which only its name is kept.
pub(super) struct Attachment {
    pub name: String,
    pub media: String,
    /// Bytes of the record before the attached file.
    pub head: usize,
    /// Bytes that the record has behind them.
    pub left: u64,
    pub checksum: Hasher,
    pub last: [u8; 4],
}

/// The attachment that `bytes` begin with; `None` if more are needed to tell.
pub(super) fn attachment(bytes: &[u8]) -> Option<Result<Attachment, &'static str>> {
    const WRONG: Option<Result<Attachment, &str>> = Some(Err("an attachment contradicts itself"));
    let mut cursor = Cursor::new(bytes);
    cursor.byte()?;
    let contents = cursor.long()?;
    let before = cursor.rest().len();
    cursor.take(8 + 8)?;
    let mut texts = [""; 2];
    for text in &mut texts {
        let mut ahead = cursor;
        if ahead.word()? as usize > LONGEST_NAME {
            return WRONG;
        }
        ahead = cursor;
        let letters = ahead.counted()?;
        let Ok(letters) = str::from_utf8(letters) else {
            return WRONG;
        };
        *text = letters;
        cursor = ahead;
    }
    let size = cursor.long()?;
    let head = before - cursor.rest().len();
    let expected = size.checked_add(head as u64 + 4);
    if expected != Some(contents) {
        return WRONG;
    }
    let mut checksum = Hasher::new();
    checksum.update(&bytes[FRAME..FRAME + head]);
    Some(Ok(Attachment {
        name: texts[0].to_owned(),
        media: texts[1].to_owned(),
        head: FRAME + head,
        left: size + 4,
        checksum,
        last: [0; 4],
    }))
}
