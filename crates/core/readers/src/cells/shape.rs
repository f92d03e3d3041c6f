//! Shape of a table: separator of its cells, first line of its rows.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::date::date_and_time;
use super::spellings::is_unit;
use pilotage_base::angle_text::degrees_of_text;
use pilotage_base::separator::Separator;

/// Lines that are looked at.
const LINES: usize = 200;
/// Longest text before the rows, in lines.
const LONGEST_TALK: usize = 100;
/// Letters that lines begin with which are remarks.
const REMARKS: [char; 3] = ['#', '%', '!'];

/// Shape of a table as text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TableShape {
    /// Separator between cells.
    pub separator: Separator,
    /// Lines before the first that belongs to the table.
    pub skipped_lines: usize,
    /// Whether the first line of the table has the names of its columns.
    pub has_header: bool,
    /// Whether the line behind it has their units.
    pub has_units: bool,
    /// Whether a comma stands before decimals.
    pub has_decimal_comma: bool,
}

impl TableShape {
    /// Shape of the table that begins so; `None` if it is none: fewer than two columns or two rows, or no column of
    /// numbers.
    ///
    /// The last line is left out, as it may be cut off.
    pub fn of(text: &str) -> Option<Self> {
        let lines: Vec<&str> = text.lines().take(LINES).collect();
        let whole = if text.ends_with('\n') {
            lines.len()
        } else {
            lines.len().saturating_sub(1)
        };
        let lines = if whole >= 3 { &lines[..whole] } else { &lines };
        let found = Separator::ALL
            .into_iter()
            .filter_map(|separator| SeparatorTrial::of(lines, separator));
        let best = found.fold(None, |best: Option<SeparatorTrial>, trial| match best {
            Some(best) if best.score >= trial.score => Some(best),
            _ => Some(trial),
        })?;
        best.shape(lines)
    }

    /// Lines of the table before its first row: names and units.
    pub fn head_lines(&self) -> usize {
        usize::from(self.has_header) + usize::from(self.has_units)
    }

    /// The number in a cell.
    pub fn number(&self, cell: &str) -> Option<f64> {
        number(cell, self.has_decimal_comma)
    }
}

/// The number in a cell: with a decimal comma where told so, else with a point. A unit may stand behind it, or the letter
/// of a hemisphere: south and west are negative. Degrees, minutes and seconds are degrees.
pub(crate) fn number(cell: &str, has_decimal_comma: bool) -> Option<f64> {
    let plain = |text: &str| -> Option<f64> {
        if has_decimal_comma && text.contains(',') {
            return text.replacen(',', ".", 1).parse().ok();
        }
        text.parse().ok()
    };
    plain(cell)
        .or_else(|| {
            let (digits, behind) = split_unit(cell)?;
            let value = plain(digits)?;
            match behind {
                // Digits alone may be packed degrees or a force: they stay the number that they are.
                "N" | "E" if !digits.contains(['.', ',']) => Some(value),
                "S" | "W" if !digits.contains(['.', ',']) => Some(-value),
                "N" | "S" | "E" | "W" => degrees_of_text(cell),
                unit => is_unit(unit).then_some(value),
            }
        })
        .or_else(|| degrees_of_text(cell))
        .or_else(|| grouped(cell))
}

/// The number of a cell with a comma before every three digits: `1,250.5`, as quoted cells have it; `0,250` is none.
fn grouped(cell: &str) -> Option<f64> {
    let bare = cell.strip_prefix(['-', '+']).unwrap_or(cell);
    let whole = bare.split('.').next()?;
    let mut groups = whole.split(',');
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let is_first = groups
        .next()
        .is_some_and(|group| group.len() <= 3 && is_number(group) && !group.starts_with('0'));
    let mut count = 0;
    let are_threes = groups.all(|group| {
        count += 1;
        group.len() == 3 && is_number(group)
    });
    (is_first && are_threes && count > 0).then(|| cell.replace(',', "").parse().ok())?
}

/// A cell that begins with a digit or sign, parted before the letters that it ends in.
fn split_unit(cell: &str) -> Option<(&str, &str)> {
    if !cell.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) {
        return None;
    }
    let end = cell.rfind(|c: char| c.is_ascii_digit() || c == '.')? + 1;
    // Units may end in digits: m/s2.
    let start = cell[..end]
        .find(|c: char| c.is_alphabetic() || c == '°')
        .filter(|start| !cell[*start..].starts_with(['e', 'E']));
    let (value, unit) = cell.split_at(start.unwrap_or(end));
    let (value, unit) = (value.trim(), unit.trim());
    (!unit.is_empty() && unit.len() <= 12).then_some((value, unit))
}

/// The unit that stands behind the number in a cell.
pub(crate) fn unit_behind(cell: &str) -> Option<&str> {
    let (_, unit) = split_unit(cell)?;
    is_unit(unit).then_some(unit)
}

/// Whether numbers of cells in quotation marks between commas have a comma before their decimals: none has a point, and some
/// comma is none of thousands.
fn are_quoted(values: &[Cow<'_, str>]) -> bool {
    let has_comma = |cell: &&Cow<'_, str>| has_decimal_comma(cell);
    let is_point = |cell: &Cow<'_, str>| cell.contains('.') && cell.parse::<f64>().is_ok();
    !values.iter().any(is_point)
        && values
            .iter()
            .filter(has_comma)
            .any(|cell| grouped(cell).is_none())
}

fn is_remark(line: &str) -> bool {
    line.trim().is_empty() || line.starts_with(REMARKS) || line.starts_with("//")
}

fn has_decimal_comma(cell: &str) -> bool {
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let parted = cell.trim_start_matches(['-', '+']).split_once(',');
    parted.is_some_and(|(whole, rest)| {
        let (fraction, power) = rest.split_once(['E', 'e']).unwrap_or((rest, "0"));
        digits(whole) && digits(fraction) && power.parse::<i32>().is_ok()
    })
}

/// Words that programs write where there is no value, in small letters.
const MISSING: [&str; 14] = [
    "null",
    "none",
    "nil",
    "n/a",
    "na",
    "#n/a",
    "#n/v",
    "n.a.",
    "nv",
    "nul",
    "undefined",
    "invalid",
    "unknown",
    "-nan",
];

/// Whether a cell says that it has no value: such a word, or nothing but dashes, question marks or stars.
pub(crate) fn is_missing(cell: &str) -> bool {
    let is_mark = !cell.is_empty() && cell.chars().all(|c| "-–—?*.".contains(c));
    is_mark || MISSING.iter().any(|word| cell.eq_ignore_ascii_case(word))
}

/// Tells whether a cell may be a value: empty, a number, or a date and time.
fn is_value(cell: &str) -> bool {
    cell.is_empty()
        || number(cell, true).is_some()
        || is_missing(cell)
        || date_and_time(cell).is_some()
}

/// Shape that a table would have with a separator.
struct SeparatorTrial {
    separator: Separator,
    /// Cells of most rows.
    count: usize,
    /// First line with so many.
    start: usize,
    score: f64,
}

impl SeparatorTrial {
    fn of(lines: &[&str], separator: Separator) -> Option<Self> {
        let counts: Vec<usize> = lines
            .iter()
            .map(|line| {
                if is_remark(line) {
                    0
                } else {
                    separator.cells(line).len()
                }
            })
            .collect();
        let told: Vec<usize> = counts.iter().copied().filter(|count| *count > 0).collect();
        // The number of cells that most lines have; of equals the larger.
        let mut sorted = told.clone();
        sorted.sort_unstable();
        let runs = sorted.chunk_by(|a, b| a == b);
        let (_, count) = runs
            .map(|run| (run.len(), run[0]))
            .filter(|(_, c)| *c > 1)
            .max()?;
        let fitting = told.iter().filter(|c| **c == count).count();
        let start = counts
            .iter()
            .position(|c| *c == count)
            .filter(|start| *start <= LONGEST_TALK)?;
        if fitting < 2 || 2 * fitting < told.len() {
            return None;
        }
        // The first may be a header.
        let rows = lines[start + 1..]
            .iter()
            .zip(&counts[start + 1..])
            .filter(|(_, c)| **c == count);
        let (mut numbers, mut cells) = (0_usize, 0_usize);
        for (line, _) in rows {
            let found = separator.cells(line);
            // Tabulators in a row are empty cells, and no blanks.
            cells += found.iter().filter(|cell| !cell.is_empty()).count();
            numbers += found
                .iter()
                .filter(|cell| !cell.is_empty() && is_value(cell))
                .count();
        }
        if numbers == 0 {
            return None;
        }
        let share = |part: usize, of: usize| part as f64 / of.max(1) as f64;
        Some(Self {
            separator,
            count,
            start,
            score: share(fitting, told.len()) * (0.25 + share(numbers, cells)),
        })
    }

    /// The line of names above the first row of the usual length: behind it there may be rows of other lengths, which have
    /// an event at their end or lost their empty cells. It has a name less than there are cells, or more: as many as the
    /// longest rows, unless it is a remark or words between blanks, which may be talk.
    fn head_above(
        &self,
        lines: &[&str],
        start: usize,
        is_head: impl Fn(&[Cow<str>]) -> bool,
    ) -> Option<usize> {
        for (at, line) in lines[..start].iter().enumerate().rev() {
            let may_be_talk = line.starts_with(REMARKS) || self.separator == Separator::Blanks;
            let cells = self
                .separator
                .cells(line.trim_start_matches(REMARKS).trim());
            if cells.len() < 2 || cells.len() + 1 < self.count {
                return None;
            }
            if is_head(&cells) {
                let named = cells.iter().take(self.count);
                let are_names = named
                    .clone()
                    .all(|cell| !cell.is_empty() && !is_value(cell));
                let is_near = cells.len() <= self.count + 1;
                let found = (is_near || are_names && !may_be_talk).then_some(at)?;
                // Units may stand below the names.
                let above = found
                    .checked_sub(1)
                    .filter(|above| !is_remark(lines[*above]));
                let is_above = |above: &usize| {
                    let names = self.separator.cells(lines[*above]);
                    names.len() == cells.len() && is_head(&names)
                };
                return Some(above.filter(is_above).unwrap_or(found));
            }
            // Between the names and the rows stand rows alone.
            if is_remark(line) || cells.len() < self.count {
                return None;
            }
        }
        None
    }

    fn shape(&self, lines: &[&str]) -> Option<TableShape> {
        let cells = |at: usize| lines.get(at).map(|line| self.separator.cells(line));
        let fits = |at: &usize| {
            !is_remark(lines[*at]) && self.separator.cells(lines[*at]).len() == self.count
        };
        // Lines that are a row or may be.
        let rows: Vec<usize> = (self.start..lines.len()).filter(fits).collect();
        let is_number = |cell: &Cow<str>| !cell.is_empty() && is_value(cell);
        let last = self.separator.cells(lines[*rows.last()?]);
        // Where later rows have numbers, a name of a column has none.
        let is_head = |row: &[Cow<str>]| {
            let pairs = row.iter().zip(&last).filter(|(_, later)| is_number(later));
            let (heads, all) = pairs.fold((0, 0), |(heads, all), (cell, _)| {
                (heads + usize::from(!is_value(cell)), all + 1)
            });
            all > 0 && 2 * heads > all
        };
        let mut start = rows[0];
        let mut has_header = is_head(&cells(start)?);
        if !has_header && let Some(head) = self.head_above(lines, start, is_head) {
            start = head;
            has_header = true;
        }
        let head_width = cells(start).map_or(0, |cells| cells.len());
        let is_as_wide = |at: usize| {
            !is_remark(lines[at]) && cells(at).is_some_and(|cells| cells.len() == head_width)
        };
        let second = (start + 1..lines.len()).find(|at| fits(at) || is_as_wide(*at));
        // Not every column has a unit in brackets below its name.
        let is_in_brackets = |cell: &Cow<str>| {
            let ends = [('(', ')'), ('[', ']')];
            let mut ends = ends.iter();
            ends.any(|(open, close)| cell.starts_with(*open) && cell.ends_with(*close))
        };
        let below = cells(start + 1).filter(|cells| cells.len() < self.count);
        let are_brackets = below.is_some_and(|cells| cells.iter().all(is_in_brackets));
        let has_units = has_header
            && (are_brackets
                || second.is_some_and(|row| cells(row).is_some_and(|cells| is_head(&cells))));
        let values = rows.iter().skip(1).filter_map(|row| cells(*row)).flatten();
        let values: Vec<Cow<str>> = values.filter(|cell| is_number(cell)).collect();
        let commas = values.iter().filter(|cell| has_decimal_comma(cell)).count();
        let shape = TableShape {
            separator: self.separator,
            skipped_lines: start,
            has_header,
            has_units,
            has_decimal_comma: 4 * commas > values.len()
                && (self.separator != Separator::Comma || are_quoted(&values)),
        };
        (rows.len() > shape.head_lines() + 1).then_some(shape)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(text: &str) -> TableShape {
        TableShape::of(text).unwrap_or_else(|| panic!("no table: {text}"))
    }

    #[test]
    fn separators_and_headers_are_found() {
        let found = shape("t,a,b\n0,1,2\n1,2,3\n");
        assert_eq!(
            (found.separator, found.has_header, found.skipped_lines),
            (Separator::Comma, true, 0)
        );
        let found = shape("0\t1\t2\n1\t2\t3\n2\t3\t4\n");
        assert_eq!((found.separator, found.has_header), (Separator::Tab, false));
        let found = shape("  0.0e+00  1.5   -2\r\n  2.0e+01  2.5   -3\r\n");
        assert_eq!(
            (found.separator, found.has_header),
            (Separator::Blanks, false)
        );
        let found = shape("time|alt\n2024-05-01 10:00:00|5\n2024-05-01 10:00:01|6\n");
        assert_eq!((found.separator, found.has_header), (Separator::Bar, true));
    }

    #[test]
    fn a_comma_before_decimals_is_no_separator() {
        let found = shape("t;v\n0,5;1,25\n1,0;2,5\n1,5;3\n");
        assert_eq!(found.separator, Separator::Semicolon);
        assert!(found.has_decimal_comma);
        assert_eq!(found.number("-1,5"), Some(-1.5));
        assert!(!shape("t,v\n0.5,1\n1.0,2\n").has_decimal_comma);
        let found = shape("t,v\n\"0,50\",\"1,25\"\n\"1,00\",\"2,5\"\n\"1,50\",3\n");
        assert_eq!(
            (found.separator, found.has_decimal_comma),
            (Separator::Comma, true)
        );
        assert!(!shape("t,v\n1,\"1,250\"\n2,\"2,500\"\n3,\"3,500\"\n").has_decimal_comma);
    }

    #[test]
    fn talk_before_the_table_and_units_below_the_names_are_passed_over() {
        let found = shape("Log of Friday\nby hand\n\ntime,alt\n[s],[m]\n0,5\n1,6\n2,7\n");
        assert_eq!(
            (found.skipped_lines, found.has_header, found.has_units),
            (3, true, true)
        );
        let found = shape("# time alt\n0 5\n1 6\n2 7\n");
        assert_eq!((found.skipped_lines, found.has_header), (0, true));
    }

    #[test]
    fn commas_before_every_three_digits_are_those_of_thousands_and_others_of_decimals() {
        for (cell, value) in [
            ("1,250.5", 1250.5),
            ("-12,345,678", -12_345_678.0),
            ("999,000", 999_000.0),
        ] {
            assert_eq!(number(cell, false), Some(value), "{cell}");
        }
        for cell in ["0,250", "1,25", "1250,500", "1,2500", ",250", "1,250,"] {
            assert_eq!(number(cell, false), None, "{cell}");
        }
        assert_eq!(number("1,250", true), Some(1.25));
    }

    #[test]
    fn whole_numbers_with_a_letter_are_the_numbers_that_they_are() {
        for (cell, value) in [
            ("1234N", 1234.0),
            ("1275 N", 1275.0),
            ("33S", -33.0),
            ("0500000E", 500_000.0),
            ("3351.0S", -33.85),
        ] {
            assert_eq!(number(cell, false), Some(value), "{cell}");
        }
    }

    #[test]
    fn names_stand_above_rows_of_other_lengths() {
        for text in [
            // An event behind the first row; two names more; empty cells lost; both.
            "t,lon,lat,event\n0,18.42,-33.85,takeoff\n1,18.42,-33.85\n2,18.42,-33.85\n3,18.42,-33.85\n",
            "t,lon,lat,event,remark\n0,18.42,-33.85\n1,18.42,-33.85\n2,18.42,-33.85\n",
            "t,lon,lat,Attribute|Value,ConvertDatV3,3.6.1\n0,18.42,-33.85\n1,18.42,-33.85\n2,18.42,-33.85\n",
            "t,lon,lat,,\n0,18.42,-33.85,,\n1,18.42,-33.85\n2,18.42,-33.85\n3,18.42,-33.85\n4,18.42,-33.85\n",
        ] {
            let found = shape(text);
            let said = (found.skipped_lines, found.has_header, found.has_units);
            assert_eq!(said, (0, true, false), "{text}");
        }
        let text = "t,lon,lat,event,remark\n[s],[deg],[deg],[],[]\n0,1,2\n1,2,3\n2,3,4\n3,4,5\n";
        let found = shape(text);
        assert_eq!((found.has_header, found.has_units), (true, true));
        // A remark below the names has no units, whatever its length.
        let found = shape("t,lat,lon\n# by me, in Zurich, 2024\n0,47,8\n1,47.1,8.1\n2,47.2,8.2\n");
        assert_eq!((found.has_header, found.has_units), (true, false));
        // Words before rows without names are talk.
        for text in [
            "Log of the flight on Friday\n0 1 2\n1 2 3\n2 3 4\n",
            "# made by hand, on Friday, in the rain, by me, again\n0,1,2\n1,2,3\n2,3,4\n",
            "Device,X1\nSerial,123\n0,47.1,8.5\n1,47.2,8.6\n2,47.3,8.7\n",
        ] {
            assert!(!shape(text).has_header, "{text}");
        }
    }

    #[test]
    fn letters_are_no_tables() {
        for text in [
            "",
            "Dear engineer, this is no log.\n",
            "Dear engineer,\n\nyours, truly,\nme, myself\n",
            "0.5\n0\n0\n-0.5\n100.25\n199.75\n",
            "name,colour\na,red\nb,blue\n",
        ] {
            assert_eq!(TableShape::of(text), None, "{text}");
        }
    }

    #[test]
    fn quotes_hold_separators_and_quotes() {
        let cells = Separator::Comma.cells(r#""a, b", 2 ,"say ""so""",,"open"#);
        assert_eq!(cells, ["a, b", "2", "say \"so\"", "", "open"]);
        assert_eq!(Separator::Tab.cells("a\t"), ["a", ""]);
    }
}
