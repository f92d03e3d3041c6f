//! Samples of a table's columns: its beginning and some places all over it.

use std::borrow::Cow;
use std::collections::BTreeSet;

use super::header::parts;
use super::makers;
use super::newest_first::oldest_first;
use super::{ColumnSample, Separator, TableShape};
use crate::cells::spellings::is_unit;
use crate::cells::{Moment, date_and_time, is_missing, unit_behind};
use crate::folder::{decoded, decoded_table};

/// Bytes of the beginning that are looked at for the shape, and of each of the places that are looked at for values.
const HEAD: usize = 1 << 16;
const PIECE: usize = 1 << 12;
/// Number of such places.
const PLACES: usize = 64;
/// Rows that tell whether one name stands over two columns.
const ROWS_OF_NAMES: usize = 50;
/// Words of names over times of a day or of a week, and over days.
const CLOCKS: [&str; 13] = [
    "time",
    "datetime",
    "timestamp",
    "clock",
    "utc",
    "gmt",
    "gpst",
    "gpstime",
    "jst",
    "hour",
    "tod",
    "tow",
    "zeit",
];
const DAYS: [&str; 4] = ["date", "day", "week", "datum"];
/// Samples of all columns, each with a name of its own, how the table is written, and which share of all rows the samples
/// are, about; `None` if it is no table.
pub(super) fn sampled(bytes: &[u8]) -> Option<(TableShape, Vec<ColumnSample>, f64)> {
    // Pieces of UTF-16 have no mark, and nothing tells whether they begin within a cell of several lines.
    let bytes = oldest_first(bytes);
    let whole = decoded_table(&bytes);
    let bytes = whole.as_ref();
    let head = text(&bytes[..bytes.len().min(HEAD)]);
    let shape = TableShape::of(&head)?;
    let (mut samples, share) = samples(&head, bytes, &shape);
    tell_apart(&mut samples);
    Some((shape, samples, share))
}

/// Gives every column a name of its own: `Alt`, `Alt (2)`; `#3` where the third has none.
fn tell_apart(samples: &mut [ColumnSample]) {
    let mut taken = BTreeSet::new();
    for (index, sample) in samples.iter_mut().enumerate() {
        if sample.name.is_empty() {
            sample.name = format!("#{}", index + 1);
        }
        let plain = sample.name.clone();
        let mut number = 1;
        while !taken.insert(sample.name.clone()) {
            number += 1;
            sample.name = format!("{plain} ({number})");
        }
    }
}

/// Text of bytes that may end within a letter.
fn text(bytes: &[u8]) -> Cow<'_, str> {
    match decoded(bytes) {
        Cow::Borrowed(bytes) => String::from_utf8_lossy(bytes),
        Cow::Owned(bytes) => Cow::Owned(String::from_utf8_lossy(&bytes).into_owned()),
    }
}

/// Gives date and time of day, or week and seconds of it, names of their own where one name stands over both, as RTKLIB has
/// it (`GPST`): in rows that have one cell more than there are names, and not an empty last one.
fn name_date_and_time(names: &mut Vec<String>, head: &str, shape: &TableShape) {
    let rows = head.lines().skip(shape.skipped_lines + shape.head_lines());
    let rows = rows.map(|row| shape.separator.cells(row));
    let rows: Vec<_> = rows
        .filter(|cells| cells.len() > 2)
        .take(ROWS_OF_NAMES)
        .collect();
    let has_more = |cells: &Vec<Cow<'_, str>>| {
        cells.len() == names.len() + 1 && cells.last().is_some_and(|cell| !cell.is_empty())
    };
    let [Some(first), Some(second)] = [names.first(), names.get(1)] else {
        return;
    };
    let (first, second) = (words_of(first), words_of(second));
    let says = |words: &[String], of: &[&str]| words.iter().any(|w| of.contains(&w.as_str()));
    let is_over_one = says(&second, &CLOCKS)
        || says(&second, &DAYS)
        || says(&first, &DAYS) && !says(&first, &CLOCKS);
    if is_over_one || !rows.iter().all(has_more) {
        return;
    }
    let is_dated = |cells: &Vec<Cow<'_, str>>| {
        let is_clock = cells[1].contains(':') && date_and_time(&cells[0]).is_none_or(is_day);
        let moment = date_and_time(&format!("{} {}", cells[0], cells[1]));
        is_clock && matches!(moment, Some(Moment::Absolute(..)))
    };
    let seconds_of_week = |cells: &Vec<Cow<'_, str>>| {
        let week: u32 = cells[0].parse().ok()?;
        let second: f64 = cells[1].parse().ok()?;
        let is_of_gps = (1000..4096).contains(&week) && (0.0..=604_800.0).contains(&second);
        is_of_gps.then_some(604_800.0 * f64::from(week) + second)
    };
    let of_week: Option<Vec<f64>> = rows.iter().map(seconds_of_week).collect();
    let goes_on = |times: Vec<f64>| times.len() > 1 && times.windows(2).all(|w| w[0] < w[1]);
    let both = if !rows.is_empty() && rows.iter().all(is_dated) {
        ["date", "time"]
    } else if says(&first, &CLOCKS) && of_week.is_some_and(goes_on) {
        ["GPS week", "time of week [s]"]
    } else {
        return;
    };
    names.splice(..1, both.map(str::to_owned));
}

/// Words of a name in small letters.
fn words_of(name: &str) -> Vec<String> {
    parts(name, "").words
}

/// Whether a moment is the beginning of a day.
fn is_day(moment: Moment) -> bool {
    matches!(moment, Moment::Absolute(whole, part) if whole % 86_400 == 0 && part == 0.0)
}

/// Units in a remark above the names, as the log cards of Garmin have it; empty where there is none.
fn units_above(head: &str, shape: &TableShape, count: usize) -> Vec<String> {
    let above = shape.skipped_lines.checked_sub(1);
    let line = above.and_then(|above| head.lines().nth(above));
    let remark = line.and_then(|line| line.strip_prefix(['#', '%', '!']));
    let cells = remark.map(|remark| shape.separator.cells(remark));
    let is_of_units = |cells: &Vec<Cow<'_, str>>| {
        let units = cells.iter().filter(|cell| is_unit(cell)).count();
        shape.has_header && cells.len() == count && units > 1
    };
    let cells = cells.filter(is_of_units).unwrap_or_default();
    cells.into_iter().map(Cow::into_owned).collect()
}

/// The unit of each name of a line, between blanks, from a line that has fewer of them: that which ends below its name, as in
/// tables whose columns are flush right; empty where none does.
fn units_below(names: &str, units: &str) -> Vec<String> {
    let cells = |line: &str| -> Vec<(usize, String)> {
        let mut end = 0;
        let mut cells = Vec::new();
        for piece in line.split_inclusive(char::is_whitespace) {
            let cell = piece.trim_end();
            let count = cell.chars().count();
            if count > 0 {
                cells.push((end + count, cell.to_owned()));
            }
            end += piece.chars().count();
        }
        cells
    };
    let units = cells(units);
    let unit = |(end, _): (usize, String)| {
        let found = units.iter().find(|(below, _)| *below == end);
        found.map_or_else(String::new, |(_, unit)| unit.clone())
    };
    cells(names).into_iter().map(unit).collect()
}

/// Samples of all columns, and which share of all rows they are, about.
fn samples(head: &str, bytes: &[u8], shape: &TableShape) -> (Vec<ColumnSample>, f64) {
    let mut lines = head.lines().skip(shape.skipped_lines);
    let mut line = || {
        lines
            .next()
            .map(|line| line.trim_start_matches(['#', '%', '!']).trim())
    };
    let names = if shape.has_header { line() } else { None };
    let units = if shape.has_units { line() } else { None };
    let cells = |line: Option<&str>| -> Vec<String> {
        let cells = line
            .map(|line| shape.separator.cells(line))
            .unwrap_or_default();
        cells.into_iter().map(Cow::into_owned).collect()
    };
    let (mut names, mut units) = (cells(names), cells(units));
    if shape.has_units && shape.separator == Separator::Blanks && units.len() < names.len() {
        let mut lines = head.lines().skip(shape.skipped_lines);
        let lines = lines.next().zip(lines.next());
        units = lines.map_or_else(Vec::new, |(names, units)| units_below(names, units));
    }
    if units.is_empty() {
        units = units_above(head, shape, names.len());
    }
    if units.is_empty() {
        units = makers::units(&names);
    }
    name_date_and_time(&mut names, head, shape);
    let mut samples: Vec<ColumnSample> = Vec::new();
    let (mut rows, mut looked_at) = (0_usize, 0_usize);
    let mut add = |line: &str| {
        if line.trim().is_empty() || line.starts_with('#') {
            return;
        }
        rows += 1;
        looked_at += line.len() + 1;
        for (index, cell) in shape.separator.cells(line).iter().enumerate() {
            if samples.len() <= index {
                samples.push(ColumnSample {
                    name: names
                        .get(index)
                        .cloned()
                        .unwrap_or_else(|| format!("#{}", index + 1)),
                    unit: units.get(index).cloned().unwrap_or_default(),
                    ..ColumnSample::default()
                });
            }
            let sample = &mut samples[index];
            match shape.number(cell) {
                Some(number) => {
                    if sample.unit.is_empty()
                        && let Some(unit) = unit_behind(cell)
                    {
                        unit.clone_into(&mut sample.unit);
                    }
                    sample.numbers.push(number);
                }
                None if cell.is_empty() || is_missing(cell) => sample.empty += 1,
                None => sample.texts.push(cell.clone().into_owned()),
            }
        }
    };
    let skipped = shape.skipped_lines + shape.head_lines();
    // The last line of a piece may be cut off.
    let whole = |text: &str| text.rfind('\n').map_or(0, |end| end + 1);
    if bytes.len() <= HEAD + PLACES * PIECE {
        // Places of a shorter table would overlap.
        let all = text(bytes);
        all.lines().skip(skipped).for_each(&mut add);
    } else {
        head[..whole(head)]
            .lines()
            .skip(skipped)
            .take(PIECE / 8)
            .for_each(&mut add);
        for place in 1..PLACES {
            let start = (bytes.len() - PIECE).max(1) / PLACES * place;
            if start < HEAD {
                continue;
            }
            let piece = text(&bytes[start..(start + PIECE).min(bytes.len())]);
            piece[..whole(&piece)].lines().skip(1).for_each(&mut add);
        }
    }
    let share = looked_at as f64 / bytes.len().max(1) as f64;
    (samples, share.clamp(1e-9, 1.0))
}
