//! The text of a table by its cells: where they stand, and others in their place.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::ops::Range;

use crate::cells::{Separator, TableShape};

/// Bytes of the beginning that tell the shape of a table, and of each of the places that tell where letters stand.
const HEAD: usize = 1 << 16;
/// Words of names of latitudes and of longitudes.
pub(super) const ANGLES: [&[&str]; 2] = [
    &[
        "lat",
        "latitude",
        "latitud",
        "breite",
        "breitengrad",
        "latitudine",
    ],
    &[
        "lon",
        "lng",
        "long",
        "longitude",
        "longitud",
        "laenge",
        "länge",
        "laengengrad",
        "längengrad",
        "longitudine",
    ],
];

/// Cells to change, and what comes there.
pub(super) type Changes = Vec<(Range<usize>, Vec<u8>)>;

/// Finds cells to change in a table, and sentences on them.
pub(super) type CellFinder = fn(&TableText) -> (Changes, Vec<String>);

/// The text of a table with a header.
pub(super) struct TableText<'a> {
    pub separator: Separator,
    pub has_decimal_comma: bool,
    /// Names of the columns.
    pub titles: Vec<Cow<'a, str>>,
    /// Bytes before the rows.
    pub start: usize,
    pub rows: &'a str,
    some: OnceCell<Vec<Vec<&'a str>>>,
}

impl<'a> TableText<'a> {
    /// The table of a whole text; `None` without a header.
    fn of(whole: &'a str) -> Option<Self> {
        let head = String::from_utf8_lossy(&whole.as_bytes()[..whole.len().min(HEAD)]);
        let shape = TableShape::of(&head).filter(|shape| shape.has_header)?;
        let header = whole.lines().nth(shape.skipped_lines)?;
        let header = header.trim_start_matches(['#', '%', '!']).trim();
        let skipped = shape.skipped_lines + shape.head_lines();
        let lines = whole.split_inclusive('\n');
        let start = lines.take(skipped).map(str::len).sum();
        Some(Self {
            separator: shape.separator,
            has_decimal_comma: shape.has_decimal_comma,
            titles: shape.separator.cells(header),
            start,
            rows: &whole[start..],
            some: OnceCell::new(),
        })
    }

    /// Cells of lines of the beginning, the middle and the end of its rows.
    pub(super) fn some_cells(&self) -> &[Vec<&'a str>] {
        self.some.get_or_init(|| {
            let lines = some_lines(self.rows).into_iter();
            lines.map(|line| bare_cells(line, self.separator)).collect()
        })
    }
}

/// The text of a table with what each of these says in the place of its cells, one after the other, and their sentences.
/// What is no table with a header stays as it is.
pub(super) fn with_changes<'a>(
    text: Cow<'a, [u8]>,
    finders: &[CellFinder],
) -> (Cow<'a, [u8]>, Vec<String>) {
    if finders.is_empty() {
        return (text, Vec::new());
    }
    let mut told = Vec::new();
    let mut found = None;
    let mut left = finders;
    if let Some(table) = std::str::from_utf8(&text).ok().and_then(TableText::of) {
        while found.is_none()
            && let Some((finder, rest)) = left.split_first()
        {
            let (changes, sentences) = finder(&table);
            told.extend(sentences);
            found = (!changes.is_empty()).then_some(changes);
            left = rest;
        }
    }
    let Some(changes) = found else {
        return (text, told);
    };
    // What comes behind looks at the changed text.
    let changed = Cow::Owned(spliced(&text, changes));
    let (changed, behind) = with_changes(changed, left);
    told.extend(behind);
    (changed, told)
}

/// A text with columns added behind those of the table whose names stand in line `number`: `added` has their names, and
/// `found` says their cells for those of a row, as many. `None` where it says none of any row; rows that are cut off stay.
pub(super) fn with_columns_behind<const N: usize>(
    text: &str,
    number: usize,
    added: [&str; N],
    found: impl Fn(&[&str]) -> Option<[String; N]>,
) -> Option<String> {
    let names = text.lines().nth(number)?;
    let separator = name_separator(names);
    let count = bare_cells(names, separator).len();
    let seam = char::from(separator.byte()).to_string();
    let mut is_any = false;
    let mut longer = |index: usize, line: &str| {
        let cells = bare_cells(line, separator);
        if index < number || cells.len() < count {
            return line.to_owned();
        }
        let behind = if index == number {
            added.map(str::to_owned).join(&seam)
        } else {
            let found = found(&cells);
            is_any |= found.is_some();
            found.map_or_else(|| [""; N].join(&seam), |cells| cells.join(&seam))
        };
        format!("{line}{seam}{behind}")
    };
    let lines = text.lines().enumerate();
    let text = joined(lines.map(|(index, line)| longer(index, line)));
    is_any.then_some(text)
}

/// Separator of the cells of RTKLIB's tables.
pub(super) fn solution_separator(line: &str) -> &'static str {
    let found = [",", ";", "\t"].into_iter();
    found.into_iter().find(|c| line.contains(*c)).unwrap_or(" ")
}

/// The cells of a line of RTKLIB's, without blanks around them.
pub(super) fn solution_cells(line: &str, separator: &str) -> Vec<String> {
    let cells: Vec<&str> = match separator {
        " " => line.split_whitespace().collect(),
        separator => line.split(separator).map(str::trim).collect(),
    };
    cells.into_iter().map(str::to_owned).collect()
}

/// Separator of a line of names: the one that it has most of.
pub(super) fn name_separator(line: &str) -> Separator {
    let found = [
        Separator::Bar,
        Separator::Comma,
        Separator::Semicolon,
        Separator::Tab,
    ];
    let count = |separator: &Separator| line.matches(char::from(separator.byte())).count();
    found
        .into_iter()
        .max_by_key(count)
        .unwrap_or(Separator::Comma)
}

/// The cells of a line, without blanks and quotation marks around them.
pub(super) fn bare_cells(line: &str, separator: Separator) -> Vec<&str> {
    let places = separator.places(line).into_iter();
    places.map(|place| &line[place]).collect()
}

/// A line with another text in the place of one of its cells.
pub(super) fn with_cell(line: &str, place: &Range<usize>, cell: &str) -> String {
    [&line[..place.start], cell, &line[place.end..]].concat()
}

/// A text of these lines.
pub(super) fn joined(lines: impl Iterator<Item = String>) -> String {
    lines.fold(String::new(), |text, line| text + &line + "\n")
}

/// Words of a name in small letters.
pub(super) fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before = ' ';
    for letter in name.chars() {
        if !letter.is_alphabetic() || before.is_lowercase() && letter.is_uppercase() {
            words.push(String::new());
        }
        if letter.is_alphabetic()
            && let Some(word) = words.last_mut()
        {
            word.extend(letter.to_lowercase());
        }
        before = letter;
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Lines of the beginning, the middle and the end of the rows of a table.
fn some_lines(rows: &str) -> Vec<&str> {
    let piece = |from: usize| {
        let mut from = from.min(rows.len());
        let mut to = (from + HEAD).min(rows.len());
        while !rows.is_char_boundary(from) {
            from += 1;
        }
        while !rows.is_char_boundary(to) {
            to -= 1;
        }
        let lines = rows[from..to.max(from)].split_inclusive('\n');
        lines
            .skip(usize::from(from > 0))
            .filter(|l| l.ends_with('\n'))
    };
    if rows.len() <= 3 * HEAD {
        return rows.lines().collect();
    }
    let starts = [0, rows.len() / 2, rows.len() - HEAD];
    starts.into_iter().flat_map(piece).collect()
}

/// A text with others in the place of some of its ranges, none of which share a byte.
fn spliced(text: &[u8], mut changes: Vec<(Range<usize>, Vec<u8>)>) -> Vec<u8> {
    changes.sort_by_key(|(range, _)| range.start);
    let mut changed = Vec::with_capacity(text.len() + changes.len());
    let mut done = 0;
    for (range, bytes) in changes {
        changed.extend_from_slice(&text[done..range.start]);
        changed.extend(bytes);
        done = range.end;
    }
    changed.extend_from_slice(&text[done..]);
    changed
}
