//! The way back after damage.

use super::attachment::attachment;
use super::chunk;
use super::contents::McapContents;
use super::magic::MAGIC;
use super::record::{
    ATTACHMENT, CHANNEL, CHUNK, FRAME, MESSAGE, MESSAGE_HEAD, SCHEMA, frame, is_known, may_begin,
    parse, whole_length,
};

/// Longest record, in bytes, that is believed after damage by what is in it alone: looking at it must not take
/// long, as it may have to be done at every byte.
const LONGEST: usize = 1 << 12;

/// Number of `bytes` before the next record that is no accident, and whether there is one. Where more bytes
/// are needed to tell, the count ends there; where `over`, no more will come.
pub(super) fn next_sure(contents: &McapContents, bytes: &[u8], over: bool) -> (usize, bool) {
    next(bytes, over, |rest| is_sure(contents, rest, over))
}

/// The same among the records of a chunk that is there as a whole.
pub(super) fn next_inside(contents: &McapContents, bytes: &[u8]) -> usize {
    let inside = |rest: &[u8]| matches!(rest.first(), Some(&(SCHEMA | CHANNEL | MESSAGE)));
    next(bytes, true, |rest| {
        if inside(rest) {
            is_sure(contents, rest, true)
        } else {
            Some(false)
        }
    })
    .0
}

fn next(bytes: &[u8], over: bool, is_sure: impl Fn(&[u8]) -> Option<bool>) -> (usize, bool) {
    for place in 0..bytes.len() {
        // Most bytes are neither a kind of record nor the first of a file.
        if !is_known(bytes[place]) && bytes[place] != MAGIC[0] {
            continue;
        }
        match is_sure(&bytes[place..]) {
            Some(true) => return (place, true),
            None if !over => return (place, false),
            Some(false) | None => {}
        }
    }
    (bytes.len(), false)
}

/// Whether a record begins here that is no accident; `None` if that takes more bytes.
fn is_sure(contents: &McapContents, bytes: &[u8], over: bool) -> Option<bool> {
    if bytes.starts_with(&MAGIC) {
        return Some(true);
    }
    if MAGIC.starts_with(bytes) {
        return None;
    }
    if !may_begin(bytes)? {
        return Some(false);
    }
    let (kind, length) = frame(bytes)?;
    match kind {
        CHUNK => return chunk::head(bytes).map(|head| head.is_ok()),
        ATTACHMENT => return attachment(bytes).map(|head| head.is_ok()),
        _ => {}
    }
    let Some(length) = whole_length(length) else {
        return Some(false);
    };
    if kind == MESSAGE {
        let channel = bytes.get(FRAME..FRAME + 2)?;
        let channel = u16::from_le_bytes([channel[0], channel[1]]);
        if !contents.is_described(channel) || length < FRAME + MESSAGE_HEAD {
            return Some(false);
        }
        return followed(bytes.get(length..)?, over);
    }
    // A schema is as long as it is, but tells its lengths at its beginning.
    if length > LONGEST && kind != SCHEMA {
        return Some(false);
    }
    let contents = bytes.get(FRAME..length)?;
    Some(parse(kind, contents).is_ok())
}

/// Whether `bytes` are what comes after a record: another one, the end of a file, the beginning of the next.
/// `None` if that takes more of them.
pub(super) fn followed(bytes: &[u8], over: bool) -> Option<bool> {
    if bytes.starts_with(&MAGIC) || bytes.is_empty() && over {
        return Some(true);
    }
    if MAGIC.starts_with(bytes) {
        return over.then_some(true);
    }
    may_begin(bytes).or(over.then_some(true))
}
