//! A CSV table and its column map.

use std::borrow::Cow;

use super::bare_angles::as_degrees;
use super::clock::{count_midnights, count_on};
use super::error::FolderError;
use super::hemispheres::as_signs;
use super::layout::{TimeColumn, ValueColumn};
use super::letter_o::as_east_or_west;
use super::row_lines::{rows_of_one_line, without_mark};
use super::standing::{SpreadRows, are_mostly, are_of_several, is_coarse, spread};
use super::table_text::{CellFinder, with_changes};
use super::thousands::as_whole;
use crate::cells::Moment;
use crate::cells::shortened;
use crate::cells::{Dimension, linear};
use crate::cells::{Separator, TableShape, number};
use crate::times::{TimeVerdict, judge};
use pilotage_base::text::{LastRow, last_row};

/// A CSV file, as text cells.
pub(crate) struct CsvTable {
    file: String,
    header: Vec<String>,
    /// Line in the file and cells.
    rows: Vec<(u64, csv::StringRecord)>,
    /// Whether cells that are no numbers count as empty.
    is_lenient: bool,
    has_decimal_comma: bool,
    /// Last line, counted from 1, and the verdict on it; one that was cut off is left out.
    pub(crate) end: (u64, LastRow),
    /// Sentences on how it was read.
    pub(crate) told: Vec<String>,
    /// Column of the clock that is coarser than the rows, and the seconds of each row after it.
    spread: Option<(String, Vec<f64>)>,
    /// Bytes of its file.
    bytes: u64,
    /// Columns that stand in its file.
    written: usize,
}

impl CsvTable {
    /// Reads a table; the separator is a comma, semicolon, tabulator or blanks, as the first line has
    /// it. Where that line is all numbers, it is the first row, and the columns are called #1, #2 ….
    pub(super) fn parse(file: &str, bytes: &[u8]) -> Result<Self, FolderError> {
        let length = bytes.len() as u64;
        let bytes = without_mark(bytes);
        let first_line = bytes.split(|b| *b == b'\n').next().unwrap_or_default();
        let header_line = String::from_utf8_lossy(first_line);
        let count = |separator: u8| header_line.matches(char::from(separator)).count();
        let separator = [Separator::Comma, Separator::Semicolon, Separator::Tab]
            .into_iter()
            .rev()
            .max_by_key(|s| count(s.byte()))
            .unwrap_or(Separator::Comma);
        let blanks =
            count(separator.byte()) == 0 && header_line.split_whitespace().nth(1).is_some();
        let separator = if blanks { Separator::Blanks } else { separator };
        let mut rows = records(file, bytes, separator, None, 0)?;
        let is_header =
            |row: &csv::StringRecord| row.iter().any(|cell| cell.parse::<f64>().is_err());
        let header: Vec<String> = match rows.first() {
            Some((_, row)) if is_header(row) => {
                let (_, row) = rows.remove(0);
                row.iter().map(str::to_owned).collect()
            }
            Some((_, row)) => (1..=row.len()).map(|i| format!("#{i}")).collect(),
            None => Vec::new(),
        };
        rows.retain(|(_, row)| row.iter().any(|cell| !cell.is_empty()));
        Ok(Self {
            file: file.to_owned(),
            written: header.len(),
            header,
            rows,
            told: Vec::new(),
            spread: None,
            is_lenient: false,
            has_decimal_comma: false,
            end: (0, LastRow::Whole),
            bytes: length,
        })
    }

    /// Reads a table of that shape whose columns are called so, and of which those are read that `is_read` says so of. Cells
    /// that make no sense count as empty.
    pub(crate) fn shaped(
        file: &str,
        bytes: &[u8],
        shape: &TableShape,
        header: Vec<String>,
        is_read: &[bool],
    ) -> Result<Self, FolderError> {
        let length = bytes.len() as u64;
        let (bytes, told) = with_changes(rows_of_one_line(bytes), &DECODING);
        let skipped = shape.skipped_lines + shape.head_lines();
        let mut rest = bytes.as_ref();
        for _ in 0..skipped {
            let end = rest
                .iter()
                .position(|b| *b == b'\n')
                .map_or(rest.len(), |end| end + 1);
            rest = &rest[end..];
        }
        let mut rows = records(file, rest, shape.separator, Some(b'#'), skipped as u64)?;
        rows.retain(|(_, row)| row.iter().any(|cell| !cell.is_empty()));
        let verdict = last_row(rest, &rows, |(_, row), column| row.get(column), is_read);
        let line = rows.last().map_or(0, |(line, _)| *line);
        if verdict == LastRow::Cut {
            rows.pop();
        }
        Ok(Self {
            file: file.to_owned(),
            written: header.len(),
            header,
            rows,
            end: (line, verdict),
            told,
            spread: None,
            is_lenient: true,
            has_decimal_comma: shape.has_decimal_comma,
            bytes: length,
        })
    }

    /// Turns its rows round: the last becomes the first.
    pub(crate) fn turn(&mut self) {
        self.rows.reverse();
    }

    /// Adds a column `name` of times, seconds: rows are `step` apart.
    pub(crate) fn number_rows(&mut self, name: &str, step: f64) {
        let width = self.header.len();
        self.header.push(name.to_owned());
        for (index, (_, row)) in self.rows.iter_mut().enumerate() {
            row.truncate(width);
            while row.len() < width {
                row.push_field("");
            }
            row.push_field(&(index as f64 * step).to_string());
        }
    }

    /// Adds a column `name` of these numbers, one per row; the cell of one that is missing is empty.
    pub(crate) fn add_numbers(
        &mut self,
        name: &str,
        numbers: impl IntoIterator<Item = Option<f64>>,
    ) {
        let width = self.header.len();
        self.header.push(name.to_owned());
        for ((_, row), number) in self.rows.iter_mut().zip(numbers) {
            row.truncate(width);
            while row.len() < width {
                row.push_field("");
            }
            row.push_field(&number.map_or_else(String::new, |number| number.to_string()));
        }
    }

    /// Leaves out the rows whose time is missing, and those whose time goes back or lies far from those around it.
    /// Returns how many.
    pub(crate) fn keep_rows_in_time(&mut self, map: &TimeColumn) -> usize {
        let Ok(index) = self.index(&map.column) else {
            return 0;
        };
        let has_comma = self.has_decimal_comma;
        let moment = |row: &csv::StringRecord| {
            let cell = point(row.get(index).unwrap_or(""), has_comma);
            map.format.parse(&cell).ok()
        };
        let moments = self.rows.iter().map(|(_, row)| moment(row));
        let mut moments: Vec<Option<Moment>> = moments.collect();
        count_midnights(moments.iter_mut().flatten());
        count_on(moments.iter_mut().flatten(), map.format);
        let origin = moments.iter().flatten().find_map(|moment| match moment {
            Moment::Absolute(whole, fraction) => Some((*whole, *fraction)),
            Moment::Relative(_) => None,
        });
        let seconds = moments
            .iter()
            .map(|m| m.map_or(f64::NAN, |m| m.since(origin)));
        let seconds: Vec<f64> = seconds.collect();
        let Some(verdicts) = judge(&seconds) else {
            return 0;
        };
        let total = self.rows.len();
        let mut kept = verdicts.iter();
        self.rows.retain(|_| {
            kept.next()
                .is_some_and(|verdict| *verdict == TimeVerdict::Sound)
        });
        total - self.rows.len()
    }

    /// Whether there is a column of that name.
    pub(crate) fn has(&self, column: &str) -> bool {
        self.header.iter().any(|name| name == column)
    }

    /// Names of the columns that stand in its file.
    pub(super) fn columns(&self) -> &[String] {
        &self.header[..self.written]
    }

    /// Bytes of its file.
    pub(super) fn bytes(&self) -> u64 {
        self.bytes
    }

    /// The numbers of a column as they stand in the cells, NaN where there is none; `None` if no cell holds any,
    /// though some hold letters.
    pub(super) fn numbers(&self, column: &str) -> Result<Option<Vec<f64>>, FolderError> {
        let texts = self.texts(column)?;
        let value = |text: &&str| number(text, self.has_decimal_comma).unwrap_or(f64::NAN);
        let numbers: Vec<f64> = texts.iter().map(value).collect();
        let is_none = numbers.iter().all(|number| number.is_nan());
        let says_nan = |text: &&str| text.is_empty() || text.eq_ignore_ascii_case("nan");
        let are_words = is_none && !texts.iter().all(says_nan);
        Ok((!are_words).then_some(numbers))
    }

    /// Number of rows.
    pub(crate) fn len(&self) -> usize {
        self.rows.len()
    }

    fn index(&self, column: &str) -> Result<usize, FolderError> {
        self.header
            .iter()
            .position(|name| name == column)
            .ok_or_else(|| FolderError::NoColumn {
                file: self.file.clone(),
                column: column.to_owned(),
                present: shortened_list(&self.header),
            })
    }

    /// Error of a cell.
    pub(super) fn cell_error(
        &self,
        row: usize,
        column: &str,
        cause: impl Into<String>,
    ) -> FolderError {
        FolderError::Cell {
            file: self.file.clone(),
            line: self.rows.get(row).map_or(0, |(line, _)| *line),
            column: column.to_owned(),
            cause: cause.into(),
        }
    }

    /// Text cells of a column, empty where a row is short.
    pub(crate) fn texts(&self, column: &str) -> Result<Vec<&str>, FolderError> {
        let index = self.index(column)?;
        Ok(self
            .rows
            .iter()
            .map(|(_, record)| record.get(index).unwrap_or(""))
            .collect())
    }

    /// Moments of a column before they are counted from an origin, with the map's offset to add.
    pub(crate) fn moments(&self, map: &TimeColumn) -> Result<Vec<Moment>, FolderError> {
        let texts = self.texts(&map.column)?.into_iter().enumerate();
        let moments = texts.map(|(row, text)| {
            map.format
                .parse(&point(text, self.has_decimal_comma))
                .map_err(|cause| self.cell_error(row, &map.column, cause))
        });
        let mut moments: Vec<Moment> = moments.collect::<Result<_, _>>()?;
        count_midnights(moments.iter_mut());
        count_on(moments.iter_mut(), map.format);
        Ok(moments)
    }

    /// Times of a column in seconds, which must not go back.
    pub(crate) fn times(
        &self,
        map: &TimeColumn,
        origin: Option<(i64, f64)>,
    ) -> Result<Vec<f64>, FolderError> {
        let mut times: Vec<f64> = self
            .moments(map)?
            .into_iter()
            .map(|moment| moment.since(origin) + map.offset_s)
            .collect();
        if let Some(back) = times.windows(2).position(|w| w[1] < w[0]) {
            return Err(self.cell_error(
                back + 1,
                &map.column,
                format!(
                    "the time goes back from {} s to {} s",
                    times[back],
                    times[back + 1]
                ),
            ));
        }
        if let Some((column, after)) = &self.spread
            && *column == map.column
        {
            times.iter_mut().zip(after).for_each(|(time, s)| *time += s);
        }
        Ok(times)
    }

    /// Whether a row and the next one measure the same columns, and not the same numbers in those that `counts` says so of.
    fn are_measurements(&self, row: usize, counts: impl Fn(usize) -> bool) -> bool {
        let (first, second) = (&self.rows[row].1, &self.rows[row + 1].1);
        let value = |cell: &str| number(cell, self.has_decimal_comma);
        let mut is_other = false;
        for (column, (a, b)) in first.iter().zip(second.iter()).enumerate() {
            if a.is_empty() != b.is_empty() {
                return false;
            }
            is_other = is_other
                || a != b && counts(column) && value(a).zip(value(b)).is_some_and(|(a, b)| a != b);
        }
        is_other
    }

    /// Has [`times`](Self::times) spread the rows of one time where its clock is coarser than its rows, or stopped; sentences
    /// on that. Rows of one time that are of several bodies are refused.
    pub(crate) fn spread_rows(&mut self, map: &TimeColumn) -> Result<Vec<String>, FolderError> {
        let (Ok(moments), Ok(at)) = (self.moments(map), self.index(&map.column)) else {
            return Ok(Vec::new());
        };
        let origin = moments.iter().find_map(|moment| match moment {
            Moment::Absolute(whole, fraction) => Some((*whole, *fraction)),
            Moment::Relative(_) => None,
        });
        let standing = moments.iter().map(|moment| moment.since(origin));
        let standing: Vec<f64> = standing.collect();
        let apart = if is_coarse(&standing) {
            self.told_apart(map, at, &standing)?
        } else {
            vec![false; self.header.len()]
        };
        let counts = |column: usize| column != at && apart.get(column) == Some(&false);
        let mut seconds = standing.clone();
        let Some(SpreadRows { is_coarse, stopped }) =
            spread(&mut seconds, |row| self.are_measurements(row, counts))
        else {
            return Ok(Vec::new());
        };
        let after = seconds.iter().zip(&standing);
        let after = after.map(|(spread, time)| spread - time).collect();
        self.spread = Some((map.column.clone(), after));
        let coarse = is_coarse.then(|| {
            "its clock is coarser than its rows: those of one time are spread until it goes on"
                .to_owned()
        });
        let stopped = (stopped > 0).then(|| {
            format!(
                "its clock stopped over {stopped} rows and went on as if it had not: they are spread evenly"
            )
        });
        Ok(coarse.into_iter().chain(stopped).collect())
    }

    /// Whether each column tells rows of one time apart, by the column `at` of times; rows of several bodies are refused.
    fn told_apart(
        &self,
        map: &TimeColumn,
        at: usize,
        standing: &[f64],
    ) -> Result<Vec<bool>, FolderError> {
        let cell = |row: usize, column: usize| self.rows[row].1.get(column).unwrap_or("");
        // Rows of several sensors fill other columns each, beside a name and the time; those of several cameras tell the same.
        let is_other = |(a, b): &(&str, &str)| {
            let both = number(a, self.has_decimal_comma).zip(number(b, self.has_decimal_comma));
            both.is_some_and(|(a, b)| a != b && (a.fract() != 0.0 || b.fract() != 0.0))
        };
        let are_alike = are_mostly(standing, |row| {
            let cells = self.rows[row].1.iter().zip(self.rows[row + 1].1.iter());
            let cells = cells.filter(|(a, b)| !a.is_empty() && !b.is_empty());
            cells.clone().count() > 3 && cells.into_iter().any(|cells| is_other(&cells))
        });
        let tells_apart = |column: usize| {
            let comma = self.has_decimal_comma;
            column != at && are_of_several(standing, |row| cell(row, column), comma)
        };
        let apart: Vec<bool> = (0..self.header.len()).map(tells_apart).collect();
        let first = apart.iter().position(|is_apart| *is_apart);
        let is_message = |column: &usize| cell(0, *column).starts_with("mavlink_");
        if (0..self.header.len()).any(|column| is_message(&column)) {
            return Err(FolderError::File {
                file: self.file.clone(),
                cause: "it is a telemetry log that Mission Planner wrote as CSV, a message a line: open the .tlog itself"
                    .to_owned(),
            });
        }
        if let Some(column) = first.filter(|_| are_alike) {
            return Err(FolderError::File {
                file: self.file.clone(),
                cause: format!(
                    "rows of one time in column \"{}\" tell of several bodies or parts, which column \"{}\" tells apart: leave one of them in the file",
                    shortened(&map.column),
                    shortened(&self.header[column])
                ),
            });
        }
        Ok(apart)
    }

    /// Values of a column in SI and radians; `None` where the cell is empty or says nan.
    pub(crate) fn values(
        &self,
        map: &ValueColumn,
        dimension: Dimension,
    ) -> Result<Vec<Option<f64>>, FolderError> {
        let factor =
            dimension
                .factor(map.unit.as_deref())
                .map_err(|cause| FolderError::Contents {
                    file: "flight.json".to_owned(),
                    place: format!("unit of column \"{}\" of {}", map.column, self.file),
                    cause,
                })?;
        self.texts(&map.column)?
            .into_iter()
            .enumerate()
            .map(|(row, text)| {
                if text.is_empty() || text.eq_ignore_ascii_case("nan") {
                    return Ok(None);
                }
                let value = number(text, self.has_decimal_comma);
                let unit = map.unit.as_deref().unwrap_or_default();
                let value = value.map(|value| linear(unit, value));
                // Minus zero degrees are west of Greenwich or south of the equator, and stay so.
                let shift = |value: f64| {
                    if map.offset == 0.0 {
                        value
                    } else {
                        value + map.offset
                    }
                };
                let value = value.map(|value| shift(value * map.scale) * factor);
                match value {
                    Some(value) if value.is_finite() => Ok(Some(value)),
                    _ if self.is_lenient => Ok(None),
                    None => {
                        let cause = format!("\"{}\" is not a number", shortened(text));
                        Err(self.cell_error(row, &map.column, cause))
                    }
                    Some(_) => Err(self.cell_error(row, &map.column, "the value is not finite")),
                }
            })
            .collect()
    }
}

/// Line in the file and cells of each row, `before` lines of which were taken already.
fn records(
    file: &str,
    bytes: &[u8],
    separator: Separator,
    remark: Option<u8>,
    before: u64,
) -> Result<Vec<(u64, csv::StringRecord)>, FolderError> {
    let (bytes, byte) = match separator {
        Separator::Blanks => (Cow::Owned(with_commas_for_blanks(bytes)), b','),
        separator => (Cow::Borrowed(bytes), separator.byte()),
    };
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(byte)
        .flexible(true)
        .has_headers(false)
        .comment(remark)
        .trim(csv::Trim::All)
        .from_reader(bytes.as_ref());
    let record = |record: csv::Result<csv::StringRecord>| {
        let record = record.map_err(|e| FolderError::File {
            file: file.to_owned(),
            cause: e.to_string(),
        })?;
        let line = record.position().map_or(0, csv::Position::line);
        Ok((before + line, record))
    };
    reader.records().map(record).collect()
}

/// A cell with a point before decimals.
fn point(cell: &str, has_decimal_comma: bool) -> Cow<'_, str> {
    if has_decimal_comma {
        Cow::Owned(cell.replacen(',', ".", 1))
    } else {
        Cow::Borrowed(cell)
    }
}

/// Finders of cells that are told otherwise than by numbers, in their order.
const DECODING: [CellFinder; 4] = [as_whole, as_degrees, as_east_or_west, as_signs];

/// The text of a table, in which every row is one line, and angles have the signs of hemispheres that change.
pub(crate) fn decoded_table(bytes: &[u8]) -> Cow<'_, [u8]> {
    with_changes(rows_of_one_line(bytes), &DECODING).0
}

/// The same lines with a comma for every run of blanks between two cells.
fn with_commas_for_blanks(bytes: &[u8]) -> Vec<u8> {
    let mut table = Vec::with_capacity(bytes.len());
    for line in bytes.split(|b| *b == b'\n') {
        let cells = line
            .split(u8::is_ascii_whitespace)
            .filter(|cell| !cell.is_empty());
        for (i, cell) in cells.enumerate() {
            if i > 0 {
                table.push(b',');
            }
            table.extend_from_slice(cell);
        }
        table.push(b'\n');
    }
    table
}

fn shortened_list(names: &[String]) -> String {
    let listed: Vec<String> = names
        .iter()
        .take(30)
        .map(|name| format!("\"{}\"", shortened(name)))
        .collect();
    listed.join(", ")
}

#[cfg(test)]
mod tests {
    use super::super::clock::TimeFormat;
    use super::*;

    fn column(name: &str, unit: &str) -> ValueColumn {
        ValueColumn {
            column: name.to_owned(),
            unit: Some(unit.to_owned()),
            scale: 1.0,
            offset: 0.0,
        }
    }

    #[test]
    fn units_and_gaps_of_somebody_elses_table_are_understood() {
        let table = CsvTable::parse("a.csv", b"t;v ;h\n0; 10;3\n1;;4\n\n2;nan\n").unwrap();
        assert_eq!(table.len(), 3);
        let speed = table.values(&column("v", "kt"), Dimension::Speed).unwrap();
        assert_eq!(speed, [Some(10.0 * 1852.0 / 3600.0), None, None]);
        let height = table.values(&column("h", "ft"), Dimension::Length).unwrap();
        assert!((height[0].unwrap() - 0.9144).abs() < 1e-12);
        assert_eq!(height[2], None);
    }

    #[test]
    fn a_table_of_bare_numbers_between_blanks_has_numbered_columns() {
        let table =
            CsvTable::parse("a.txt", b"  0.0e+00  1.5   -2\r\n  2.0e+01  2.5   -3\n").unwrap();
        assert_eq!(table.len(), 2);
        let second = table.values(&column("#2", "m"), Dimension::Length);
        assert_eq!(second.unwrap(), [Some(1.5), Some(2.5)]);
        let wrong = table.values(&column("#4", "m"), Dimension::Length);
        assert!(
            wrong
                .unwrap_err()
                .to_string()
                .contains("it has \"#1\", \"#2\", \"#3\"")
        );
    }

    #[test]
    fn rows_are_lines_whatever_stands_in_quotation_marks_or_ends_them() {
        let flat =
            |text: &str| String::from_utf8(decoded_table(text.as_bytes()).into_owned()).unwrap();
        assert_eq!(
            flat("a,\"b\nc \"\"d\"\"\"\n1,2\n"),
            "a,\"b c \"\"d\"\"\"\n1,2\n"
        );
        // Marks of seconds are no quotation marks.
        let angles = "a,47°30'36\"N\nb,47°30'37\"N\n";
        assert_eq!(flat(angles), angles);
        let open = "a,\"b\n1,2\n";
        assert_eq!(flat(open), open);
        assert_eq!(flat("a,b\r1,2\r"), "a,b\n1,2\n");
        let unmarked: Vec<u8> = "t,é\n1,2\n"
            .encode_utf16()
            .flat_map(u16::to_le_bytes)
            .collect();
        assert_eq!(decoded_table(&unmarked).as_ref(), "t,é\n1,2\n".as_bytes());
    }

    #[test]
    fn a_bad_cell_is_named_by_line_and_column() {
        let table = CsvTable::parse("a.csv", b"t,v\n0,1\n1,x\n").unwrap();
        let wrong = table
            .values(&column("v", "m"), Dimension::Length)
            .unwrap_err();
        assert_eq!(
            wrong.to_string(),
            "a.csv, line 3, column \"v\": \"x\" is not a number"
        );
        let wrong = table
            .values(&column("w", "m"), Dimension::Length)
            .unwrap_err();
        assert!(wrong.to_string().contains("it has \"t\", \"v\""), "{wrong}");
        let wrong = table
            .values(&column("v", "kg"), Dimension::Length)
            .unwrap_err();
        assert!(wrong.to_string().contains("use one of m, ft"), "{wrong}");
    }

    #[test]
    fn a_time_that_goes_back_is_refused() {
        let table = CsvTable::parse("a.csv", b"t\n0\n2\n1\n").unwrap();
        let map = TimeColumn {
            column: "t".to_owned(),
            format: TimeFormat::Seconds,
            offset_s: 0.0,
        };
        let wrong = table.times(&map, None).unwrap_err();
        assert!(
            matches!(wrong, FolderError::Cell { line: 4, .. }),
            "{wrong}"
        );
    }

    #[test]
    fn rows_are_spread_only_where_that_is_asked_for() {
        let row = |row: u32| format!("{},{row}\n", row / 4);
        let rows: String = (0..40).map(row).collect();
        let text = format!("t,v\n{rows}");
        let mut table = CsvTable::parse("a.csv", text.as_bytes()).unwrap();
        let map = TimeColumn {
            column: "t".to_owned(),
            format: TimeFormat::Seconds,
            offset_s: 2.0,
        };
        assert_eq!(table.times(&map, None).unwrap()[..3], [2.0; 3]);
        assert!(!table.spread_rows(&map).unwrap().is_empty());
        assert_eq!(table.times(&map, None).unwrap()[..3], [2.0, 2.25, 2.5]);
    }
}
