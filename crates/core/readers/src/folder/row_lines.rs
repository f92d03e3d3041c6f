//! The text of tables: in UTF-8, every row a line, whatever lines the cells in quotation marks have.

use std::borrow::Cow;

use super::receivers::plain;
use pilotage_base::text::of_utf_16;

/// Longest cell in quotation marks that may have several lines, bytes.
const LONGEST_CELL: usize = 1 << 14;

/// The bytes behind the mark of UTF-8.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// The text in UTF-8: UTF-16 by its mark or its zeros; what is no UTF-8 is taken for Latin-1, in which degrees are one byte.
/// Lines that end in carriage returns alone end as others do.
pub(crate) fn decoded(bytes: &[u8]) -> Cow<'_, [u8]> {
    let bytes = without_mark(bytes);
    if let Some(text) = of_utf_16(bytes) {
        return Cow::Owned(text.into_bytes());
    }
    let text = match str::from_utf8(bytes) {
        // At the end a letter may be cut off.
        Err(error) if error.error_len().is_some() => {
            let text: String = bytes.iter().copied().map(char::from).collect();
            Cow::Owned(text.into_bytes())
        }
        _ => Cow::Borrowed(bytes),
    };
    if text.contains(&b'\r') && !text.contains(&b'\n') {
        let ended = text.iter().map(|b| if *b == b'\r' { b'\n' } else { *b });
        return Cow::Owned(ended.collect());
    }
    text
}

/// The text of a table, in which every row is one line: blanks stand for the ends of lines within quotation marks.
pub(crate) fn rows_of_one_line(bytes: &[u8]) -> Cow<'_, [u8]> {
    let text = plain(decoded(bytes));
    if !text.contains(&b'"') {
        return text;
    }
    let mut flat = None;
    let mut at = 0;
    let mut is_begin = true;
    while let Some(byte) = text.get(at) {
        if *byte == b'"' && is_begin {
            let Some(end) = end_of_quoted(&text, at) else {
                at += 1;
                is_begin = false;
                continue;
            };
            let has_lines = text[at..end].iter().any(|b| matches!(b, b'\n' | b'\r'));
            if has_lines {
                let flat: &mut Vec<u8> = flat.get_or_insert_with(|| text.to_vec());
                let inside = flat[at..end].iter_mut();
                inside
                    .filter(|b| matches!(**b, b'\n' | b'\r'))
                    .for_each(|b| *b = b' ');
            }
            at = end;
            is_begin = false;
            continue;
        }
        is_begin = is_seam(*byte) || *byte == b' ' && is_begin;
        at += 1;
    }
    flat.map_or(text, Cow::Owned)
}

/// Whether a byte parts cells or rows.
fn is_seam(byte: u8) -> bool {
    matches!(byte, b',' | b';' | b'\t' | b'|' | b'\n' | b'\r')
}

/// Place behind the cell that begins with a quotation mark at `start`; `None` where no mark ends it before
/// [`LONGEST_CELL`] bytes.
fn end_of_quoted(text: &[u8], start: usize) -> Option<usize> {
    let most = text.len().min(start + LONGEST_CELL);
    let mut at = start + 1;
    while at < most {
        if text[at] != b'"' {
            at += 1;
        } else if text.get(at + 1) == Some(&b'"') {
            at += 2;
        } else {
            let is_end = text.get(at + 1).is_none_or(|next| is_seam(*next));
            return is_end.then_some(at + 1);
        }
    }
    None
}
