//! Texts as programs write and people read them.

use std::collections::BTreeSet;

/// The text of bytes that begin with the mark of UTF-16, as Excel and Windows write it, or in whose first 64 bytes every
/// other one is zero and the others are letters; what is no character becomes U+FFFD. `None` of anything else.
///
/// ```
/// use pilotage_base::text::of_utf_16;
///
/// let unmarked = b"t\0,\0v\0\n\0";
/// assert_eq!(of_utf_16(unmarked).as_deref(), Some("t,v\n"));
/// // Small numbers of 16 bits.
/// assert_eq!(of_utf_16(b"\x01\0\x02\0\x03\0\x04\0"), None);
/// ```
pub fn of_utf_16(bytes: &[u8]) -> Option<String> {
    let head = &bytes[..bytes.len().min(64) & !1];
    let are_zero = |at: usize| {
        let (zeros, others) = (
            head.iter().skip(at).step_by(2),
            head.iter().skip(1 - at).step_by(2),
        );
        let is_written = |b: u8| b >= b' ' || b.is_ascii_whitespace();
        head.len() >= 8 && zeros.copied().all(|b| b == 0) && others.copied().all(is_written)
    };
    let (rest, unit): (_, fn([u8; 2]) -> u16) = match bytes {
        [0xff, 0xfe, rest @ ..] => (rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => (rest, u16::from_be_bytes),
        rest if are_zero(1) => (rest, u16::from_le_bytes),
        rest if are_zero(0) => (rest, u16::from_be_bytes),
        _ => return None,
    };
    let units: Vec<u16> = rest
        .chunks_exact(2)
        .map(|pair| unit([pair[0], pair[1]]))
        .collect();
    Some(String::from_utf16_lossy(&units))
}

/// A name without what files must not have in theirs.
///
/// ```
/// use pilotage_base::text::plain_name;
///
/// assert_eq!(plain_name("Mill: A/B 2"), "Mill--A-B-2");
/// ```
pub fn plain_name(name: &str) -> String {
    let fit = |c: char| {
        let is_plain = c.is_alphanumeric() || matches!(c, '-' | '_' | '.');
        if is_plain { c } else { '-' }
    };
    name.chars().map(fit).collect()
}

/// Names of files in one folder, none of which is another's or one of `taken`: with a number behind those that would be. Big
/// and small letters are the same, as they are to some systems.
///
/// ```
/// use pilotage_base::text::distinct_names;
///
/// let told = distinct_names(["Mill", "mill", "Barn"], ["barn"]);
/// assert_eq!(told, ["Mill", "mill-2", "Barn-2"]);
/// ```
pub fn distinct_names<N: Into<String>>(
    names: impl IntoIterator<Item = N>,
    taken: impl IntoIterator<Item = N>,
) -> Vec<String> {
    let mut all: BTreeSet<String> = (taken.into_iter())
        .map(|name| name.into().to_lowercase())
        .collect();
    let distinct = |name: N| {
        let name = name.into();
        let numbered = (2..).map(|number| format!("{name}-{number}"));
        let mut possible = std::iter::once(name.clone()).chain(numbered);
        let free = possible.find(|name| all.insert(name.to_lowercase()));
        free.unwrap_or(name)
    };
    names.into_iter().map(distinct).collect()
}

/// The words that go with a count: `one` with one of a kind, `several` with any other number.
///
/// ```
/// use pilotage_base::text::by_count;
///
/// let told = |count| format!("{count} {}", by_count(count, "row was", "rows were"));
/// assert_eq!((told(1).as_str(), told(0).as_str()), ("1 row was", "0 rows were"));
/// ```
pub fn by_count<'a>(count: usize, one: &'a str, several: &'a str) -> &'a str {
    if count == 1 { one } else { several }
}

/// Verdict of the end of a table's text on its last row.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LastRow {
    /// Nothing speaks against it.
    #[default]
    Whole,
    /// It has all that is needed; whether more stood behind, nobody can tell.
    MayBeCut,
    /// It lacks a cell that is needed, or ends within one.
    Cut,
}

/// Rows before the last one that it is held against.
const COMPARED_ROWS: usize = 20;

/// Judges the last row of a table by those before it: a line without an end may have been cut off. `cell` is the cell of a row
/// in a column, and `is_needed` says of each column whether a row is of no use without it.
///
/// A needed cell at the very end counts as cut where it has fewer decimals than all of the column before it, and other cells are
/// missing behind it.
pub fn last_row<R>(
    text: &[u8],
    rows: &[R],
    cell: impl Fn(&R, usize) -> Option<&str>,
    is_needed: &[bool],
) -> LastRow {
    let [others @ .., last] = rows else {
        return LastRow::Whole;
    };
    let others = &others[others.len().saturating_sub(COMPARED_ROWS)..];
    let Some(before) = others
        .last()
        .filter(|_| !text.ends_with(b"\n") && !text.ends_with(b"\r"))
    else {
        return LastRow::Whole;
    };
    let mut lacking = (0..is_needed.len())
        .filter(|column| cell(before, *column).is_some() && cell(last, *column).is_none())
        .peekable();
    let is_short = lacking.peek().is_some();
    if lacking.any(|column| is_needed[column]) {
        return LastRow::Cut;
    }
    let written = |row: &R| (0..is_needed.len()).rfind(|column| cell(row, *column).is_some());
    let is_within = written(last)
        .filter(|column| is_needed[*column])
        .is_some_and(|column| {
            let before: Vec<&str> = others.iter().filter_map(|row| cell(row, column)).collect();
            cell(last, column).is_some_and(|cell| lacks_letters(cell, &before))
        });
    match (is_short, is_within) {
        (true, true) => LastRow::Cut,
        (false, false) => LastRow::Whole,
        _ => LastRow::MayBeCut,
    }
}

/// Whether a cell seems to lack its last letters: it has fewer decimals than any other of its column, or whole numbers of far
/// fewer digits, or does not end in a letter or mark as all others do.
fn lacks_letters(cell: &str, others: &[&str]) -> bool {
    let decimals = |cell: &str| {
        let rest = cell.rsplit_once(['.', ',']).map_or("", |(_, rest)| rest);
        rest.bytes().take_while(u8::is_ascii_digit).count()
    };
    let digits = |cell: &str| cell.bytes().filter(u8::is_ascii_digit).count();
    let ends_in_mark = |cell: &str| !cell.ends_with(|c: char| c.is_ascii_digit());
    let least = |count: &dyn Fn(&str) -> usize| others.iter().map(|cell| count(cell)).min();
    let has_fewer_decimals = least(&decimals).is_some_and(|least| decimals(cell) < least);
    let are_whole = others.iter().all(|cell| !cell.contains(['.', ',']));
    let has_fewer_digits =
        are_whole && least(&digits).is_some_and(|least| digits(cell) + 2 <= least);
    let lacks_mark =
        !others.is_empty() && others.iter().all(|cell| ends_in_mark(cell)) && !ends_in_mark(cell);
    has_fewer_decimals || has_fewer_digits || lacks_mark
}

/// A text with its first letter in capitals, unless it begins with the name of a file.
pub fn capitalised(text: &str) -> String {
    if begins_with_file(text) {
        return text.to_owned();
    }
    let mut letters = text.chars();
    let first = letters.next().map(char::to_uppercase).into_iter().flatten();
    first.chain(letters).collect()
}

/// Whether the first word is the name of a file.
fn begins_with_file(text: &str) -> bool {
    let word = text.split([' ', ':']).next().unwrap_or("");
    let ending = word.rsplit_once('.').map_or("", |(_, ending)| ending);
    !ending.is_empty() && ending.chars().all(char::is_alphanumeric)
}

/// A text in which nothing is taken for the markup of HTML or XML, and without the control characters that XML forbids.
///
/// ```
/// use pilotage_base::text::without_markup;
///
/// assert_eq!(without_markup("a < \"b\" & c"), "a &lt; &quot;b&quot; &amp; c");
/// assert_eq!(without_markup("it's\u{0}\tso"), "it&apos;s\tso");
/// ```
pub fn without_markup(text: &str) -> String {
    let is_allowed = |c: char| c >= ' ' || ['\t', '\n', '\r'].contains(&c);
    let mut safe = String::with_capacity(text.len());
    for character in text.chars().filter(|c| is_allowed(*c)) {
        match character {
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '&' => safe.push_str("&amp;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&apos;"),
            other => safe.push(other),
        }
    }
    safe
}

/// A number with a comma before its decimals as one with a point, without the dots, blanks or apostrophes before every three
/// digits; `None` of anything else.
///
/// ```
/// use pilotage_base::text::without_decimal_comma;
///
/// let plain = |text| without_decimal_comma(text);
/// assert_eq!(plain("-1.234.567,8").as_deref(), Some("-1234567.8"));
/// assert_eq!(plain("5 432,5e1").as_deref(), Some("5432.5e1"));
/// assert_eq!(plain("5.432.100").as_deref(), Some("5432100"));
/// // One dot may be that of decimals.
/// assert_eq!((plain("1.234"), plain("12.34,5"), plain("1,2,3")), (None, None, None));
/// ```
pub fn without_decimal_comma(text: &str) -> Option<String> {
    let bare = text.strip_prefix(['-', '+']).unwrap_or(text);
    let sign = &text[..text.len() - bare.len()];
    let are_digits = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
    let (whole, decimals) = match bare.split_once(',') {
        Some((whole, decimals)) => (whole, Some(decimals)),
        None => (bare, None),
    };
    let (fraction, power) = match decimals.map(|rest| rest.split_once(['e', 'E'])) {
        Some(Some((fraction, power))) => (Some(fraction), power.parse::<i32>().ok().map(Some)?),
        Some(None) => (decimals, None),
        None => (None, None),
    };
    if !fraction.is_none_or(are_digits) {
        return None;
    }
    let seam = whole.chars().find(|c| !c.is_ascii_digit());
    let digits = match seam {
        None => whole.to_owned(),
        Some(seam) if [".", " ", "\u{a0}", "\u{202f}", "'", "’"].contains(&&*seam.to_string()) => {
            let groups: Vec<&str> = whole.split(seam).collect();
            let is_one_dot = seam == '.' && groups.len() == 2 && fraction.is_none();
            let are_threes = groups[1..].iter().all(|group| group.len() == 3);
            if !are_threes || groups[0].len() > 3 || groups[0].starts_with('0') || is_one_dot {
                return None;
            }
            groups.concat()
        }
        Some(_) => return None,
    };
    if !are_digits(&digits) || seam.is_none() && fraction.is_none() {
        return None;
    }
    let fraction = fraction.map_or_else(String::new, |fraction| format!(".{fraction}"));
    let power = power.map_or_else(String::new, |power| format!("e{power}"));
    Some(format!("{sign}{digits}{fraction}{power}"))
}

/// A cell of a CSV table, in quotation marks where it needs them.
pub fn csv_cell(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) {
        in_quotes(cell)
    } else {
        cell.to_owned()
    }
}

/// A cell of a CSV table in quotation marks; its own are doubled.
pub fn in_quotes(cell: &str) -> String {
    format!("\"{}\"", cell.replace('"', "\"\""))
}

/// Date and time (UTC) of seconds since 1970 as ISO 8601 writes them, to the microsecond:
/// `2014-05-18T10:20:31.250Z`. Years beyond 9999 and before 0 are written as they come.
///
/// ```
/// use pilotage_base::text::utc_text;
///
/// // 1 January 2000 is 10 957 days after 1 January 1970.
/// assert_eq!(utc_text(10_957.0 * 86_400.0 + 1.5), "2000-01-01T00:00:01.500Z");
/// ```
pub fn utc_text(seconds: f64) -> String {
    let micro = (seconds * 1e6).round();
    let days = (micro / 86_400e6).floor();
    let rest = micro - days * 86_400e6;
    let (year, month, day) = civil_date(days as i64);
    let whole = (rest / 1e6).floor();
    let (hours, minutes) = ((whole / 3600.0).floor(), (whole % 3600.0 / 60.0).floor());
    let part = format!("{:06.0}", rest - 1e6 * whole);
    let part = if part.ends_with("000") {
        &part[..3]
    } else {
        &part
    };
    let seconds = whole % 60.0;
    format!("{year:04}-{month:02}-{day:02}T{hours:02.0}:{minutes:02.0}:{seconds:02.0}.{part}Z")
}

/// Year, month and day of a number of days since 1970-01-01 in the Gregorian calendar.
pub fn civil_date(days: i64) -> (i64, i64, i64) {
    // Counted from 0000-03-01, so that the leap day ends the year.
    let shifted = days.saturating_add(719_468);
    let era = shifted.div_euclid(146_097);
    let day_of_era = shifted.rem_euclid(146_097);
    let year_of_era =
        (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = (month_from_march + 2) % 12 + 1;
    let year = year_of_era + 400 * era + i64::from(month <= 2);
    (year, month, day)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar_to_the_microsecond() {
        assert_eq!(utc_text(0.0), "1970-01-01T00:00:00.000Z");
        assert_eq!(utc_text(951_782_400.0), "2000-02-29T00:00:00.000Z");
        assert_eq!(utc_text(1_400_408_431.25), "2014-05-18T10:20:31.250Z");
        assert_eq!(
            utc_text(1_400_408_431.999_999_9),
            "2014-05-18T10:20:32.000Z"
        );
        assert_eq!(utc_text(-0.5), "1969-12-31T23:59:59.500Z");
        assert_eq!(utc_text(59.000_25), "1970-01-01T00:00:59.000250Z");
    }

    #[test]
    fn utf_16_is_read_by_its_mark_in_either_order() {
        let text = "Zürich 🛩";
        let units: Vec<u16> = text.encode_utf16().collect();
        let little: Vec<u8> = units.iter().flat_map(|unit| unit.to_le_bytes()).collect();
        let big: Vec<u8> = units.iter().flat_map(|unit| unit.to_be_bytes()).collect();
        let read = |mark: [u8; 2], rest: &[u8]| of_utf_16(&[&mark[..], rest].concat());
        assert_eq!(read([0xff, 0xfe], &little).as_deref(), Some(text));
        assert_eq!(read([0xfe, 0xff], &big).as_deref(), Some(text));
        assert_eq!(of_utf_16(text.as_bytes()), None);
    }

    #[test]
    fn a_first_letter_becomes_a_capital_and_nothing_else_changes() {
        assert_eq!(capitalised("über alles"), "Über alles");
        assert_eq!(capitalised("2 rows"), "2 rows");
        assert_eq!(capitalised(""), "");
        for named in ["march.png was left out", "photos/a.jpg: no place"] {
            assert_eq!(capitalised(named), named);
        }
        assert_eq!(capitalised("no place. a.jpg"), "No place. a.jpg");
    }

    #[test]
    fn a_cell_is_quoted_where_a_reader_would_part_it() {
        assert_eq!(in_quotes("plain"), "\"plain\"");
        assert_eq!(csv_cell("plain"), "plain");
        assert_eq!(csv_cell("a,b"), "\"a,b\"");
        assert_eq!(csv_cell("5\" gun"), "\"5\"\" gun\"");
    }
}
