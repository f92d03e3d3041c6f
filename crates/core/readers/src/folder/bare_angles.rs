//! Latitudes and longitudes in degrees, minutes and seconds that have nothing but blanks or colons between them.

use std::borrow::Cow;

use super::table_text::{ANGLES, Changes, TableText, words};
use crate::cells::Separator;

/// Degrees of a cell of two or three numbers: `-0 25 12.5`, `51:28.63`; `None` of a plain number and of anything else.
fn degrees(cell: &str) -> Option<f64> {
    let parts = cell.split([' ', ':']).filter(|part| !part.is_empty());
    let parts: Vec<&str> = parts.collect();
    let (first, rest) = parts.split_first()?;
    let (last, middle) = rest.split_last()?;
    let is_whole = |part: &&str| part.bytes().all(|b| b.is_ascii_digit());
    let bare = first.trim_start_matches(['-', '+']);
    if middle.len() > 1 || !is_whole(&bare) || !middle.iter().all(is_whole) {
        return None;
    }
    let has_sign = last.starts_with(['-', '+']);
    let mut amount: f64 = bare.parse().ok()?;
    for (part, per_degree) in middle.iter().chain([last]).zip([60.0, 3600.0]) {
        let value: f64 = part.parse().ok().filter(|v| (0.0..60.0).contains(v))?;
        amount += value / per_degree;
    }
    let signed = if first.starts_with('-') {
        -amount
    } else {
        amount
    };
    (!has_sign && amount <= 180.0).then_some(signed)
}

/// Cells to change where the latitudes and longitudes of a table both are so, and degrees in their place.
pub(super) fn as_degrees(table: &TableText) -> (Changes, Vec<String>) {
    (changes(table).unwrap_or_default(), Vec::new())
}

/// These; `None` where latitude and longitude are none.
fn changes(table: &TableText) -> Option<Changes> {
    let separator = table.separator;
    // Between blanks they are cells of their own.
    if separator == Separator::Blanks {
        return None;
    }
    let titles = &table.titles;
    let column = |names: &[&str]| {
        let is_named = |title: &Cow<str>| words(title).iter().any(|w| names.contains(&w.as_str()));
        let is_it = |at: &usize| {
            let cells = table.some_cells().iter().filter_map(|row| row.get(*at));
            let cells: Vec<&str> = cells.copied().filter(|cell| !cell.is_empty()).collect();
            let count = cells.iter().filter(|cell| degrees(cell).is_some()).count();
            count > 2 && 10 * count >= 9 * cells.len()
        };
        (0..titles.len()).find(|at| is_named(&titles[*at]) && is_it(at))
    };
    let mut columns = [column(ANGLES[0])?, column(ANGLES[1])?];
    columns.sort_unstable();
    let mut changes = Vec::new();
    let mut begin = table.start;
    for line in table.rows.split_inclusive('\n') {
        let places = separator.places(line);
        for place in columns.iter().filter_map(|at| places.get(*at)) {
            if let Some(degrees) = degrees(&line[place.clone()]) {
                let range = begin + place.start..begin + place.end;
                changes.push((range, format!("{degrees:.10}").into_bytes()));
            }
        }
        begin += line.len();
    }
    Some(changes)
}

#[cfg(test)]
mod tests {
    use super::super::table_text::with_changes;
    use super::*;

    fn read(text: &str) -> String {
        let (read, _) = with_changes(Cow::Borrowed(text.as_bytes()), &[as_degrees]);
        String::from_utf8(read.into_owned()).unwrap()
    }

    #[test]
    fn numbers_between_blanks_are_degrees_minutes_and_seconds_where_both_columns_have_them() {
        let row = |i: usize| format!("{i},51 28 3{i}.5,-0 25 12.0,100\n");
        let table = |row: &dyn Fn(usize) -> String| {
            let rows: String = (0..6).map(row).collect();
            format!("time,latitude,longitude,alt\n{rows}")
        };
        let found = read(&table(&row));
        assert!(
            found.contains("\n3,51.4759722222,-0.4200000000,100\n"),
            "{found}"
        );
        let minutes = |i: usize| format!("{i},51:28.{i},-0:25.2,100\n");
        let found = read(&table(&minutes));
        assert!(found.contains("\n3,51.4716666667,-0.4200000000,100\n"));
        // Both numbers of a place stand in one cell, or it is a plain number.
        for cells in ["51 28.5,7", "51.5,7.25", "51 28 99,7 25 12"] {
            let text = table(&|i| format!("{i},{cells},100\n"));
            assert_eq!(read(&text), text);
        }
    }
}
