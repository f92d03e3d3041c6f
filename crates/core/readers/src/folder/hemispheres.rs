//! Hemispheres that change from row to row, in a column behind that of their angle.
//!
//! A flight over the equator or over Greenwich has `N` in some rows and `S` in others. South and west become signs of the
//! angles, and all letters those of north and east, so that the rest of a table is read as any other.

use std::borrow::Cow;
use std::ops::Range;

use crate::cells::TableShape;

/// Bytes of the beginning that tell the shape of a table.
const HEAD: usize = 1 << 16;
/// Letters that leave an angle as it is, and those that turn it.
const PAIRS: [[u8; 2]; 2] = [*b"NS", *b"EW"];

/// A column of angles, and that of their letters behind it.
struct Letters {
    at: usize,
    pair: [u8; 2],
    /// Rows with either letter.
    counts: [usize; 2],
}

/// The letter of a cell, alone or as the first of its word.
fn letter(cell: &str) -> Option<u8> {
    let words = ["north", "south", "east", "west"];
    let is_word = cell.len() == 1 || words.iter().any(|word| word.eq_ignore_ascii_case(cell));
    let first = cell.bytes().next()?.to_ascii_uppercase();
    (is_word && PAIRS.concat().contains(&first)).then_some(first)
}

/// Whether a cell is an angle without a sign.
fn is_angle(cell: &str) -> bool {
    cell.starts_with(|c: char| c.is_ascii_digit())
        && cell
            .parse::<f64>()
            .or_else(|_| cell.replacen(',', ".", 1).parse())
            .is_ok()
}

/// The text of a table with the signs that its letters of hemispheres tell, where these change.
pub(super) fn with_signs(text: Cow<'_, [u8]>) -> Cow<'_, [u8]> {
    let head = String::from_utf8_lossy(&text[..text.len().min(HEAD)]).into_owned();
    let Some(shape) = TableShape::of(&head) else {
        return text;
    };
    let skipped = shape.skipped_lines + shape.head_lines();
    let Some(first) = head.lines().nth(skipped) else {
        return text;
    };
    let cells = shape.separator.cells(first);
    let found = (1..cells.len()).filter_map(|at| {
        let pair = PAIRS
            .into_iter()
            .find(|pair| letter(&cells[at]).is_some_and(|l| pair.contains(&l)))?;
        is_angle(&cells[at - 1]).then_some(Letters {
            at,
            pair,
            counts: [0; 2],
        })
    });
    let mut found: Vec<Letters> = found.collect();
    if found.is_empty() {
        return text;
    }
    let Ok(whole) = std::str::from_utf8(&text) else {
        return text;
    };
    let lines = whole.split('\n').skip(skipped);
    for line in lines.clone() {
        let cells = shape.separator.cells(line.trim_end_matches('\r'));
        found.retain_mut(
            |letters| match cells.get(letters.at).map(|cell| letter(cell)) {
                Some(Some(letter)) if letters.pair.contains(&letter) => {
                    letters.counts[usize::from(letter == letters.pair[1])] += 1;
                    is_angle(&cells[letters.at - 1])
                }
                // A row without an angle, or one that is cut off.
                Some(None) => cells[letters.at].is_empty() && cells[letters.at - 1].is_empty(),
                None => true,
                Some(Some(_)) => false,
            },
        );
    }
    found.retain(|letters| letters.counts.iter().all(|count| *count > 0));
    if found.is_empty() {
        return text;
    }
    let mut changes: Vec<(Range<usize>, Vec<u8>)> = Vec::new();
    for line in lines {
        let cells = shape.separator.cells(line.trim_end_matches('\r'));
        for letters in &found {
            let pair = cells.get(letters.at - 1).zip(cells.get(letters.at));
            let Some((Cow::Borrowed(angle), Cow::Borrowed(word))) = pair else {
                continue;
            };
            if letter(word) == Some(letters.pair[1]) {
                // Cells are borrowed from the text.
                let begin = |cell: &str| cell.as_ptr() as usize - whole.as_ptr() as usize;
                let at = begin(angle);
                changes.push((at..at, b"-".to_vec()));
                let at = begin(word);
                changes.push((at..at + word.len(), vec![letters.pair[0]]));
            }
        }
    }
    changes.sort_by_key(|(range, _)| range.start);
    let mut signed = Vec::with_capacity(text.len() + changes.len());
    let mut done = 0;
    for (range, bytes) in changes {
        signed.extend_from_slice(&text[done..range.start]);
        signed.extend(bytes);
        done = range.end;
    }
    signed.extend_from_slice(&text[done..]);
    Cow::Owned(signed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signed(text: &str) -> String {
        let text = with_signs(Cow::Borrowed(text.as_bytes())).into_owned();
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn letters_that_change_become_signs_and_others_stay() {
        let rows = |first: &str, last: &str, name: &str| {
            let row = |i: u32, letter: &str| format!("{i},47.{i},N,0.0{i},{letter},{}\r\n", i % 2);
            format!("t,lat,{name},lon,EW,ok\r\n")
                + &(0..20)
                    .map(|i| row(i, if i < 9 { first } else { last }))
                    .collect::<String>()
        };
        let found = signed(&rows("W", "E", "NS"));
        assert!(
            found.contains("\r\n3,47.3,N,-0.03,E,1\r\n")
                && found.contains("\r\n9,47.9,N,0.09,E,1\r\n")
        );
        assert!(signed(&rows("west", "East", "NS")).contains("3,47.3,N,-0.03,E,1\r\n"));
        for same in [
            rows("W", "W", "NS"),
            rows("E", "E", "NS"),
            rows("W", "F", "NS"),
        ] {
            assert_eq!(signed(&same), same);
        }
        let negative = rows("W", "E", "NS").replace("0.03", "-0.03");
        assert_eq!(signed(&negative), negative);
    }
}
