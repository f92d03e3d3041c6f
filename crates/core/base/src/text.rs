//! Texts as programs write and people read them.

/// The text of bytes that begin with the mark of UTF-16, as Excel and Windows write it; what is no character becomes
/// U+FFFD. `None` without the mark.
pub fn of_utf_16(bytes: &[u8]) -> Option<String> {
    let (rest, unit): (_, fn([u8; 2]) -> u16) = match bytes {
        [0xff, 0xfe, rest @ ..] => (rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => (rest, u16::from_be_bytes),
        _ => return None,
    };
    let units: Vec<u16> = rest
        .chunks_exact(2)
        .map(|pair| unit([pair[0], pair[1]]))
        .collect();
    Some(String::from_utf16_lossy(&units))
}

/// A text with its first letter in capitals.
pub fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(char::to_uppercase).into_iter().flatten();
    first.chain(letters).collect()
}

/// A cell of a CSV table, in quotation marks where it needs them.
pub fn csv_cell(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
    }

    #[test]
    fn a_cell_is_quoted_where_a_reader_would_part_it() {
        assert_eq!(csv_cell("plain"), "plain");
        assert_eq!(csv_cell("a,b"), "\"a,b\"");
        assert_eq!(csv_cell("5\" gun"), "\"5\"\" gun\"");
    }
}
