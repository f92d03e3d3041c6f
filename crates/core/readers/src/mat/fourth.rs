//! MATLAB's files of version 4: a header of five numbers, a name and a matrix, one variable after the other.

use super::element::{MatElement, number};
use super::value::{MatValue, MatVariables, text_of};

/// Bytes of the header of a variable.
const HEADER: usize = 20;
/// Longest name that is believed.
const LONGEST_NAME: usize = 64;
/// Types of elements of version 5 that the numbers of version 4 are stored like: real numbers of 8 and 4 bytes, whole ones
/// of 4, 2, 2 without a sign, and 1.
const KINDS: [(u32, usize); 6] = [(9, 8), (7, 4), (5, 4), (3, 2), (4, 2), (2, 1)];

/// The variables of a file; `None` if it does not begin as such a file does.
pub fn variables(bytes: &[u8]) -> Option<MatVariables> {
    let mut found = MatVariables::default();
    let mut rest = bytes;
    while !rest.is_empty() {
        let Some((name, value, length)) = variable(rest) else {
            found.is_damaged = true;
            break;
        };
        found.all.push((name, value));
        rest = &rest[length..];
    }
    (!found.all.is_empty()).then_some(found)
}

/// The first variable, and how many bytes it has.
fn variable(bytes: &[u8]) -> Option<(String, MatValue, usize)> {
    let header = bytes.get(..HEADER)?;
    // The first number says in its digits how the others are stored: thousands for the order of bytes, tens for their
    // type, ones for letters and sparse matrices.
    let is_big = number(&header[..4], false) > 9999;
    let part = |at: usize| number(&header[4 * at..4 * at + 4], is_big) as usize;
    let kind = part(0).checked_sub(if is_big { 1000 } else { 0 })?;
    let (stored, size) = *KINDS.get(kind / 10)?;
    let [rows, columns, is_complex, name_length] = [part(1), part(2), part(3), part(4)];
    if kind % 10 > 2 || is_complex > 1 || !(2..=LONGEST_NAME).contains(&name_length) {
        return None;
    }
    let begin = HEADER + name_length;
    let (last, name) = bytes.get(HEADER..begin)?.split_last()?;
    if *last != 0 || !name.iter().all(u8::is_ascii_graphic) {
        return None;
    }
    let end = rows
        .checked_mul(columns)?
        .checked_mul(size)?
        .checked_add(begin)?;
    let whole = (end - begin)
        .checked_mul(1 + is_complex)?
        .checked_add(begin)?;
    bytes.get(..whole)?;
    let element = MatElement {
        kind: stored,
        data: bytes[begin..end].into(),
        is_big,
    };
    let values = element.numbers()?;
    let value = match kind % 10 {
        0 => MatValue::Numbers {
            rows,
            columns,
            values,
        },
        1 => {
            let letters = values.iter().map(|code| char::from(*code as u8)).collect();
            text_of(letters, rows)
        }
        _ => MatValue::Other,
    };
    Some((String::from_utf8_lossy(name).into_owned(), value, whole))
}
