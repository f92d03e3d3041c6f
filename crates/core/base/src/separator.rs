//! Separators between the cells of tables as text, and the cells that they part.

use std::borrow::Cow;
use std::ops::Range;

use serde::{Deserialize, Serialize};

/// Separator between the cells of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Separator {
    /// `,`
    Comma,
    /// `;`
    Semicolon,
    /// A tabulator.
    Tab,
    /// `|`
    Bar,
    /// Any number of blanks.
    Blanks,
}

impl Separator {
    /// Every one, the likeliest first.
    pub const ALL: [Self; 5] = [
        Self::Comma,
        Self::Semicolon,
        Self::Tab,
        Self::Bar,
        Self::Blanks,
    ];

    /// The byte that it is; a blank for any number of them.
    pub fn byte(self) -> u8 {
        match self {
            Self::Comma => b',',
            Self::Semicolon => b';',
            Self::Tab => b'\t',
            Self::Bar => b'|',
            Self::Blanks => b' ',
        }
    }

    /// The cells of a line, without blanks and quotes around them.
    ///
    /// ```
    /// use pilotage_base::separator::Separator;
    ///
    /// assert_eq!(Separator::Comma.cells("1, 2 ,\"a,\"\"b\"\"\",\n"), ["1", "2", "a,\"b\"", ""]);
    /// assert_eq!(Separator::Blanks.cells(" 1   2\n"), ["1", "2"]);
    /// ```
    pub fn cells(self, line: &str) -> Vec<Cow<'_, str>> {
        if self == Self::Blanks {
            return line.split_whitespace().map(Cow::Borrowed).collect();
        }
        let mut cells = Vec::new();
        let mut rest = line;
        loop {
            let (cell, after) = next_cell(rest, char::from(self.byte()));
            cells.push(cell);
            match after {
                Some(after) => rest = after,
                None => return cells,
            }
        }
    }

    /// Places of the cells of a line, without blanks and quotation marks around them.
    ///
    /// ```
    /// use pilotage_base::separator::Separator;
    ///
    /// assert_eq!(Separator::Semicolon.places("1; 2 ;\"a;b\""), [0..1, 3..4, 7..10]);
    /// ```
    pub fn places(self, line: &str) -> Vec<Range<usize>> {
        let begin = |part: &str| part.as_ptr() as usize - line.as_ptr() as usize;
        let place = |cell: &str| {
            let cell = cell.trim();
            let bare = cell.strip_prefix('"').and_then(|c| c.strip_suffix('"'));
            let cell = bare.unwrap_or(cell).trim();
            begin(cell)..begin(cell) + cell.len()
        };
        if self == Self::Blanks {
            return line.split_whitespace().map(place).collect();
        }
        let mut places = Vec::new();
        let mut start = 0;
        let mut is_quoted = false;
        for (at, byte) in line.bytes().enumerate() {
            if byte == b'"' && (is_quoted || line[start..at].trim().is_empty()) {
                is_quoted = !is_quoted;
            } else if byte == self.byte() && !is_quoted {
                places.push(place(&line[start..at]));
                start = at + 1;
            }
        }
        places.push(place(&line[start..]));
        places
    }
}

/// The first cell of what is left of a line, and what is left behind it.
fn next_cell(line: &str, separator: char) -> (Cow<'_, str>, Option<&str>) {
    let Some(quoted) = line.trim_start_matches(' ').strip_prefix('"') else {
        return match line.split_once(separator) {
            Some((cell, rest)) => (Cow::Borrowed(cell.trim()), Some(rest)),
            None => (Cow::Borrowed(line.trim()), None),
        };
    };
    let mut cell = String::new();
    let mut letters = quoted.char_indices().peekable();
    while let Some((place, letter)) = letters.next() {
        if letter != '"' {
            cell.push(letter);
        } else if letters.next_if(|(_, next)| *next == '"').is_some() {
            cell.push('"');
        } else {
            let behind = &quoted[place + 1..];
            let rest = behind.split_once(separator).map(|(_, rest)| rest);
            return (Cow::Owned(cell.trim().to_owned()), rest);
        }
    }
    (Cow::Owned(cell.trim().to_owned()), None)
}
