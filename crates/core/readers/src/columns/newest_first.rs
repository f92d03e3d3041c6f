//! Tables whose newest row is the first, turned round so that their times go on.

use std::borrow::Cow;

use super::names::meanings;
use super::{ColumnRole, TableShape};
use crate::cells::{Moment, date_and_time};
use crate::folder::rows_of_one_line;

/// Bytes of the beginning that tell whether the rest is looked at.
const HEAD: usize = 1 << 16;
/// Fewest rows that tell it.
const FEWEST: usize = 5;
/// So many times fewer steps than rows may go the other way: over midnight, of a wrong time.
const RARE: usize = 50;

/// The table with its oldest row first, for looking at its rows; as it is where it is so already, or no column of times tells.
pub(super) fn oldest_first(bytes: &[u8]) -> Cow<'_, [u8]> {
    let Some((whole, shape)) = newest_first(bytes) else {
        return Cow::Borrowed(bytes);
    };
    let text = String::from_utf8_lossy(&whole);
    let before = shape.skipped_lines + shape.head_lines();
    let mut lines: Vec<&str> = text.lines().collect();
    lines[before..].reverse();
    let mut turned = lines.join("\n").into_bytes();
    turned.push(b'\n');
    Cow::Owned(turned)
}

/// Whether the newest row of a table is its first.
pub(super) fn begins_with_newest(bytes: &[u8]) -> bool {
    newest_first(bytes).is_some()
}

/// The table in lines and its shape, where its newest row is the first.
fn newest_first(bytes: &[u8]) -> Option<(Cow<'_, [u8]>, TableShape)> {
    let head = rows_of_one_line(&bytes[..bytes.len().min(HEAD)]);
    let begins = String::from_utf8_lossy(&head);
    let shape = TableShape::of(&begins).filter(|shape| is_newest_first(&begins, shape))?;
    let whole = rows_of_one_line(bytes);
    is_newest_first(&String::from_utf8_lossy(&whole), &shape).then_some((whole, shape))
}

/// Whether a column of times goes back from row to row, and none goes on.
fn is_newest_first(text: &str, shape: &TableShape) -> bool {
    let names = text.lines().nth(shape.skipped_lines);
    let Some(names) = names.filter(|_| shape.has_header) else {
        return false;
    };
    let names = shape
        .separator
        .cells(names.trim_start_matches(['#', '%', '!']));
    let rows = text.lines().skip(shape.skipped_lines + shape.head_lines());
    let rows = rows.filter(|line| !line.trim().is_empty() && !line.starts_with('#'));
    let rows: Vec<Vec<Cow<'_, str>>> = rows.map(|line| shape.separator.cells(line)).collect();
    let mut is_any = false;
    for (column, name) in names.iter().enumerate() {
        let are_dates = || {
            let cell = rows.first().and_then(|row| row.get(column));
            cell.is_some_and(|cell| shape.number(cell).is_none())
        };
        if !(is_called_time(name) || are_dates()) {
            continue;
        }
        let cells = rows.iter().filter_map(|row| row.get(column));
        let times: Vec<f64> = cells.filter_map(|cell| seconds(cell, shape)).collect();
        if times.len() < FEWEST {
            continue;
        }
        let count = |is: fn(f64, f64) -> bool| times.windows(2).filter(|w| is(w[0], w[1])).count();
        let (on, back) = (count(|a, b| b > a), count(|a, b| b < a));
        if RARE * back < times.len() && on > 0 {
            return false;
        }
        // A clock may be coarser than the rows.
        is_any |= RARE * on < times.len() && 100 * back >= times.len() && back >= FEWEST - 1;
    }
    is_any
}

fn seconds(cell: &str, shape: &TableShape) -> Option<f64> {
    shape.number(cell).or_else(|| match date_and_time(cell)? {
        Moment::Absolute(whole, fraction) => Some(whole as f64 + fraction),
        Moment::Relative(seconds) => Some(seconds),
    })
}

fn is_called_time(name: &str) -> bool {
    let parts = super::header::parts(name, "");
    let named = meanings(&parts.words)
        .into_iter()
        .chain(meanings(parts.plain_words()));
    let mut named = named.filter(|guess| guess.role == ColumnRole::Time);
    named.any(|guess| guess.confidence > 0.5)
}

#[cfg(test)]
mod tests {
    use super::super::tests::files;
    use super::super::{flight_of_tables, guess_table, guess_tables};

    /// A table of 60 rows a second apart, north at 15 m/s, in the order of `rows`.
    fn table(time: impl Fn(u32) -> String, name: &str, rows: &[u32]) -> String {
        let row = |row: &u32| {
            let north = 47.1 + f64::from(*row) * 15.0 / 111_185.0;
            format!("{},{north:.7},8.5,{},\"a, b\"\n", time(*row), 500 + row)
        };
        let rows: String = rows.iter().map(row).collect();
        format!("{name},lat,lon,altitude [m],remark\n{rows}")
    }

    #[test]
    fn a_table_whose_newest_row_is_first_is_the_same_flight_and_that_is_told() {
        let plain = |row: u32| f64::from(row).to_string();
        let dated = |row: u32| format!("2024-05-01T10:00:{row:02}Z");
        let of_day = |row: u32| {
            format!(
                "{:02}:{:02}:{:02}",
                (86_370 + row) % 86_400 / 3600,
                (86_370 + row) % 3600 / 60,
                row % 60
            )
        };
        let times: [(&str, &dyn Fn(u32) -> String); 3] = [
            ("time [s]", &plain),
            ("timestamp", &dated),
            ("time", &of_day),
        ];
        for (name, time) in times {
            let forward: Vec<u32> = (0..60).collect();
            let backward: Vec<u32> = (0..60).rev().collect();
            let states = |rows: &[u32]| {
                let text = table(time, name, rows);
                let files = files(&[("a.csv", &text)]);
                let maps = [guess_table("a.csv", text.as_bytes()).expect(name)];
                let guessed = guess_tables(files.as_ref(), &files.names());
                assert!(guessed[0].is_proposed, "{name}");
                let folder = flight_of_tables(&files, &maps).expect(name);
                let is_told = folder.notes.iter().any(|note| note.contains("newest row"));
                (folder.flight.truth.expect(name).states, is_told)
            };
            let (right, is_told) = states(&forward);
            assert!(!is_told && right.len() == 60, "{name}");
            let (found, is_told) = states(&backward);
            assert!(is_told, "{name}");
            assert_eq!(found.len(), 60, "{name}");
            for (found, right) in found.iter().zip(&right) {
                assert!((found.time - right.time).abs() < 1e-9, "{name}");
                assert!((found.position - right.position).norm() < 1e-6, "{name}");
            }
        }
    }

    #[test]
    fn the_last_line_of_a_table_from_its_end_is_left_out_where_the_file_is_cut_off_in_it() {
        let time = |row: u32| row.to_string();
        let rows: Vec<u32> = (0..60).rev().collect();
        let text = table(time, "time [s]", &rows);
        let begin = text.trim_end().rfind('\n').unwrap() + 1;
        // Within the latitude, behind it, and within the remark, which is not read.
        for (kept, is_left_out) in [(7, true), (12, true), (24, false)] {
            let cut = &text[..begin + kept];
            let map = guess_table("a.csv", text.as_bytes()).unwrap();
            let folder = flight_of_tables(&files(&[("a.csv", cut)]), &[map]).unwrap();
            let notes = &folder.notes;
            let told = |words: &str| notes.iter().any(|note| note.contains(words));
            assert!(told("newest row"), "{kept}: {notes:?}");
            assert_eq!(
                told("line 61: the last line has no end"),
                is_left_out,
                "{kept}: {notes:?}"
            );
            let states = folder.flight.truth.unwrap().states;
            assert_eq!(states.len(), 60 - usize::from(is_left_out), "{kept}");
            let step = states[1].position.x - states[0].position.x;
            assert!((step - 15.0).abs() < 0.5, "{kept}: {step}");
        }
    }

    #[test]
    fn a_counter_that_is_full_and_a_table_from_its_end_are_told_apart_also_where_both_are() {
        for (name, length) in [
            ("time_us", 1_u64 << 32),
            ("time_ms", 1 << 32),
            ("time_ms", 1 << 16),
        ] {
            let second = if name == "time_us" { 1_000_000 } else { 1000 };
            for count in [60_u32, 200] {
                // Full after a third of the rows, or forty.
                let begin = length - u64::from(count / 3).min(40) * second + second / 3;
                let time = |row: u32| ((begin + u64::from(row) * second) % length).to_string();
                let forward: Vec<u32> = (0..count).collect();
                let backward: Vec<u32> = (0..count).rev().collect();
                for (rows, is_turned) in [(&forward, false), (&backward, true)] {
                    let text = table(time, name, rows);
                    let files = files(&[("a.csv", &text)]);
                    let case = format!("{name} {length} {count} {is_turned}");
                    let map = guess_table("a.csv", text.as_bytes()).expect(&case);
                    let folder = flight_of_tables(&files, &[map]).expect(&case);
                    let is_told = folder.notes.iter().any(|note| note.contains("newest row"));
                    assert_eq!(is_told, is_turned, "{case}: {:?}", folder.notes);
                    let states = folder.flight.truth.expect(&case).states;
                    assert_eq!(states.len(), count as usize, "{case}");
                    for (state, row) in states.iter().zip(0..count) {
                        let since = state.time - states[0].time;
                        assert!((since - f64::from(row)).abs() < 1e-6, "{case}: {since}");
                        let north = state.position.x - states[0].position.x;
                        assert!(
                            (north - 15.0 * f64::from(row)).abs() < 0.5,
                            "{case}: {north}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn a_time_that_is_left_beside_a_clock_turns_nothing() {
        let both = |row: u32| format!("{row},{}", 600 - row);
        let rows: Vec<u32> = (0..60).collect();
        let text = table(both, "time [s],time remaining [s]", &rows);
        let map = guess_table("a.csv", text.as_bytes()).unwrap();
        let folder = flight_of_tables(&files(&[("a.csv", &text)]), &[map]).unwrap();
        assert!(!folder.notes.iter().any(|note| note.contains("newest row")));
        let states = folder.flight.truth.unwrap().states;
        assert!(states.last().unwrap().position.x > states[0].position.x);
    }
}
