//! Lines that stand before the names of a table's columns, and the character between its cells.

use super::csv_columns::{CsvRole, columns};
use super::csv_table::are_named_xy;

/// Characters that part cells, those that mostly do first.
const DELIMITERS: [char; 4] = [',', ';', '\t', '|'];

/// Beginning of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct CsvPreface<'a> {
    /// The table from the line of names on.
    pub table: &'a str,
    /// Number of lines before that.
    pub lines: u64,
    /// Character between its cells.
    pub delimiter: char,
}

/// Passes over empty lines, comments and the `sep=;` that Excel heeds, up to the names of the columns.
pub(super) fn preface(content: &str) -> CsvPreface<'_> {
    let (mut table, mut lines, mut told) = (content, 0, None);
    while let Some((line, rest)) = table.split_once('\n') {
        let line = line.trim_end_matches('\r');
        let lower = line.trim_matches('"').to_lowercase();
        if let Some(cell) = lower.strip_prefix("sep=") {
            told = told.or_else(|| cell.chars().next());
        } else if !line.trim().is_empty() && !is_comment(line) {
            // Names behind a `#` are called as they would be without.
            let names = table.trim_start();
            table = names.strip_prefix('#').map_or(table, str::trim_start);
            break;
        }
        table = rest;
        lines += 1;
    }
    let told = told.filter(|c| DELIMITERS.contains(c));
    let delimiter = told.unwrap_or_else(|| delimiter_of(table.lines().next().unwrap_or("")));
    CsvPreface {
        table,
        lines,
        delimiter,
    }
}

/// The character that a line has most of.
fn delimiter_of(line: &str) -> char {
    let count = |c: char| line.matches(c).count();
    let most = DELIMITERS
        .into_iter()
        .max_by_key(|c| (count(*c), *c == ','));
    most.unwrap_or(',')
}

/// Whether a line is a comment: some programs have the names of columns behind a `#` as well.
pub(super) fn is_comment(line: &str) -> bool {
    let Some(text) = line.trim_start().strip_prefix('#') else {
        return false;
    };
    !names_places(text)
}

/// Whether a line has the names of columns of places.
pub(super) fn names_places(line: &str) -> bool {
    let names = line
        .split(delimiter_of(line))
        .map(|name| name.trim().trim_matches('"').to_owned());
    let names: Vec<String> = names.collect();
    let says = |word: &str| names.iter().any(|name| name.to_lowercase().contains(word));
    says("easting") && says("northing")
        || are_named_xy(&names)
        || columns(&names)
            .is_ok_and(|columns| columns.iter().any(|c| c.role == Some(CsvRole::Latitude)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_before_the_names_are_passed_over() {
        for (content, lines, delimiter) in [
            ("name,lat,lon\n", 0, ','),
            ("sep=;\r\nname;lat;lon\n", 1, ';'),
            ("\"sep=\t\"\nname\tlat\tlon\n", 1, '\t'),
            ("# made, by, whom\n\n# 2024\nname|lat|lon\n", 3, '|'),
            ("# name,lat,lon\nA,1,2\n", 0, ','),
            ("# WGS 84\n#Label,X/Longitude,Y/Latitude\nlat,1,2\n", 1, ','),
        ] {
            let found = preface(content);
            assert_eq!(
                (found.lines, found.delimiter),
                (lines, delimiter),
                "{content}"
            );
            assert!(found.table.contains("lat"), "{content}");
            assert!(found.table.starts_with(['n', 'L']), "{content}");
        }
    }
}
