//! Numbers with dots, blanks or apostrophes before every three digits, in tables with a comma before decimals.

use super::table_text::{Changes, TableText};
use crate::cells::Separator;
use pilotage_base::text::without_decimal_comma;

/// Cells to change in the columns where something tells that thousands are parted, without what parts them, and a sentence on
/// those where it may as well be the point of decimals.
pub(super) fn as_whole(table: &TableText) -> (Changes, Vec<String>) {
    if !table.has_decimal_comma || table.separator == Separator::Comma {
        return (Changes::new(), Vec::new());
    }
    let some = table.some_cells();
    let kind = |column: usize| Parted::of(some.iter().filter_map(|row| row.get(column).copied()));
    let kinds: Vec<Parted> = (0..table.titles.len()).map(kind).collect();
    let of = |wanted: Parted| {
        let columns = kinds.iter().enumerate();
        columns.filter_map(move |(column, kind)| (*kind == wanted).then_some(column))
    };
    let told = of(Parted::Doubtful).map(|column| {
        format!(
            "a dot in column \"{}\" may part thousands or decimals, where others have commas before decimals; taken: decimals",
            table.titles[column]
        )
    });
    let told = told.collect();
    let parted: Vec<usize> = of(Parted::Thousands).collect();
    let mut changes = Changes::new();
    if parted.is_empty() {
        return (changes, told);
    }
    let mut begin = table.start;
    for line in table.rows.split_inclusive('\n') {
        let places = table.separator.places(line);
        for place in parted.iter().filter_map(|column| places.get(*column)) {
            if let Some(cell) = joined(&line[place.clone()]) {
                changes.push((begin + place.start..begin + place.end, cell.into_bytes()));
            }
        }
        begin += line.len();
    }
    (changes, told)
}

/// Meaning of the dots of a column.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Parted {
    /// They part thousands.
    Thousands,
    /// All cells have one dot before three digits: nothing tells.
    Doubtful,
    /// There are none, or they are those of decimals.
    No,
}

impl Parted {
    /// Of the cells of a column: thousands are parted where a comma stands behind them, or where all other cells have fewer
    /// digits and none a comma.
    fn of<'a>(cells: impl Iterator<Item = &'a str>) -> Self {
        let (mut with_comma, mut whole, mut short) = (false, false, false);
        for cell in cells.filter(|cell| !cell.is_empty()) {
            let digits = cell.trim_start_matches(['-', '+']);
            let is_short = digits.len() <= 3 && digits.bytes().all(|b| b.is_ascii_digit());
            match joined(cell) {
                Some(_) if cell.contains(',') => with_comma = true,
                Some(_) => whole = true,
                None if is_short => short = true,
                None if without_decimal_comma(cell).is_some() => {}
                None => return Self::No,
            }
        }
        match (with_comma, whole, short) {
            (true, ..) | (_, true, true) => Self::Thousands,
            (_, true, _) => Self::Doubtful,
            _ => Self::No,
        }
    }
}

/// A number whose thousands are parted without what parts them, its comma kept.
fn joined(cell: &str) -> Option<String> {
    let parts = ['.', ' ', '\u{a0}', '\u{202f}', '\'', '’'];
    if !cell.contains(parts) {
        return None;
    }
    if cell.contains(',') {
        return without_decimal_comma(cell).map(|plain| plain.replacen('.', ",", 1));
    }
    let plain = without_decimal_comma(&format!("{cell},0"))?;
    plain.strip_suffix(".0").map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use std::borrow::Cow;
    use std::sync::Arc;

    use super::super::table_text::with_changes;
    use super::*;
    use crate::columns::guess_table;
    use pilotage_base::files::{FileSet, MemoryFiles};

    fn heights(cells: &[&str]) -> (Vec<String>, Vec<String>) {
        let row = |(i, height): (usize, &&str)| format!("{i},5;47,{i:04}1;8,5{i:03};{height}\n");
        let rows: String = cells.iter().enumerate().map(row).collect();
        let text = format!("Zeit (s);Breitengrad;Längengrad;Höhe (m)\n{rows}");
        let (read, told) = with_changes(Cow::Borrowed(text.as_bytes()), &[as_whole]);
        let read = String::from_utf8(read.into_owned()).unwrap();
        let last = |line: &str| line.rsplit(';').next().unwrap().to_owned();
        (read.lines().skip(1).map(last).collect(), told)
    }

    #[test]
    fn thousands_are_parted_where_commas_or_shorter_numbers_tell() {
        for (cells, right) in [
            (["999,5", "1.000,5", "1.001"], ["999,5", "1000,5", "1001"]),
            (
                ["1 000,5", "1 001,5", "12 002,5"],
                ["1000,5", "1001,5", "12002,5"],
            ),
            (
                ["1\u{202f}000,5", "1\u{202f}001,0", "1\u{202f}002,5"],
                ["1000,5", "1001,0", "1002,5"],
            ),
            (["999", "1.000", "1.001"], ["999", "1000", "1001"]),
            (["-1.234.567,8", "1,5", ""], ["-1234567,8", "1,5", ""]),
            // Points of decimals.
            (["1.25", "1.250", "1"], ["1.25", "1.250", "1"]),
            (["0.998", "1.001", "1"], ["0.998", "1.001", "1"]),
        ] {
            assert_eq!(
                heights(&cells),
                (right.map(str::to_owned).to_vec(), Vec::new())
            );
        }
        let (same, told) = heights(&["1.001", "1.002", "1.003"]);
        assert_eq!(same, ["1.001", "1.002", "1.003"]);
        assert!(
            told[0].contains("\"Höhe (m)\"") && told[0].contains("thousands"),
            "{told:?}"
        );
    }

    #[test]
    fn other_tables_stay_as_they_are() {
        for text in [
            "t;v;w\n1.5;1.001;3\n2.5;999;4\n",
            "t,v\n1,\"1.000,5\"\n2,\"1.001,5\"\n",
            "",
        ] {
            let (read, told) = with_changes(Cow::Borrowed(text.as_bytes()), &[as_whole]);
            assert_eq!((&*read, told), (text.as_bytes(), Vec::new()));
        }
    }

    #[test]
    fn heights_with_parted_thousands_are_those_of_the_flight() {
        let row = |i: u32| {
            let (north, height) = (f64::from(i) * 1e-4, 995 + i);
            let height = format!("{}.{:03}", height / 1000, height % 1000);
            let height = height.trim_start_matches("0.");
            format!(
                "{},5;{};8,5;{height}\n",
                i,
                format!("{:.5}", 47.0 + north).replace('.', ",")
            )
        };
        let rows: String = (0..60).map(row).collect();
        let text = format!("Zeit (s);Breitengrad;Längengrad;Höhe (m)\n{rows}");
        let map = guess_table("a.csv", text.as_bytes()).unwrap();
        let file = ("a.csv".to_owned(), text.into_bytes());
        let files: Arc<dyn FileSet> = Arc::new(MemoryFiles([file].into()));
        let folder = crate::columns::flight_of_tables(&files, &[map]).unwrap();
        let heights = folder
            .flight
            .channel(pilotage_flight::ChannelName::GpsHeight);
        let heights = &heights.unwrap().values;
        assert_eq!((heights[0], heights[59]), (995.0, 1054.0));
    }
}
