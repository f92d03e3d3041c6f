//! The text of a file, whatever letters it is written in.

/// Letters of windows-1252 from 0x80 to 0x9F; elsewhere it is Latin-1.
const WESTERN: &str = "€\u{81}‚ƒ„…†‡ˆ‰Š‹Œ\u{8d}Ž\u{8f}\u{90}‘’“”•–—˜™š›œ\u{9d}žŸ";
/// Letters of windows-1251 from 0x80 to 0xBF; behind them stands the Russian alphabet.
const CYRILLIC: &str =
    "ЂЃ‚ѓ„…†‡€‰Љ‹ЊЌЋЏђ‘’“”•–—\u{98}™љ›њќћџ\u{a0}ЎўЈ¤Ґ¦§Ё©Є«¬\u{ad}®Ї°±Ііґµ¶·ё№є»јЅѕї";

/// The text of a file: UTF-8, else windows-1251 or windows-1252 (Latin-1) as its XML declaration says, which is told.
pub(super) fn decoded(bytes: &[u8], notes: &mut Vec<String>) -> String {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if let Ok(text) = std::str::from_utf8(bytes) {
        return text.to_owned();
    }
    let stated = stated(bytes);
    let letter = |byte: u8| match (stated.as_str(), byte) {
        (_, 0..0x80) => char::from(byte),
        ("windows-1251" | "cp1251", 0xc0..) => {
            char::from_u32(0x410 + u32::from(byte) - 0xc0).unwrap_or('\u{fffd}')
        }
        ("windows-1251" | "cp1251", _) => nth(CYRILLIC, byte),
        (_, 0x80..0xa0) => nth(WESTERN, byte),
        _ => char::from(byte),
    };
    notes.push(match stated.as_str() {
        "windows-1251" | "cp1251" => "the text is read as windows-1251, as it says".to_owned(),
        "windows-1252" | "cp1252" | "iso-8859-1" | "latin1" | "utf-8" | "" => {
            "the text is not UTF-8: it is read as Latin-1".to_owned()
        }
        other => format!(
            "the text is {other}, which is not known: it is read as Latin-1, and letters may be wrong"
        ),
    });
    bytes.iter().map(|byte| letter(*byte)).collect()
}

/// The letter of a byte in a row that begins at 0x80.
fn nth(row: &str, byte: u8) -> char {
    let mut letters = row.chars();
    letters.nth(usize::from(byte) - 0x80).unwrap_or('\u{fffd}')
}

/// The encoding that an XML declaration states, in small letters, or nothing.
fn stated(bytes: &[u8]) -> String {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(200)]).to_lowercase();
    let declaration = head.split("?>").next().unwrap_or("");
    let word = declaration.split_once("encoding").map(|(_, rest)| rest);
    let quoted = word.and_then(|rest| rest.split(['"', '\'']).nth(1));
    quoted.unwrap_or("").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_read_in_the_letters_that_they_state() {
        // Python: "<?xml encoding='windows-1251'?>Москва Ё №".encode("cp1251"), and the same of other letters.
        let of = |head: &str, letters: &[u8]| {
            let mut notes = Vec::new();
            let text = decoded(&[head.as_bytes(), letters].concat(), &mut notes);
            (text[head.len()..].to_owned(), notes)
        };
        let russian = b"\xcc\xee\xf1\xea\xe2\xe0 \xa8 \xb9";
        let head = "<?xml version=\"1.0\" encoding=\"windows-1251\"?>";
        let (text, notes) = of(head, russian);
        assert_eq!(text, "Москва Ё №");
        assert!(notes[0].contains("windows-1251"), "{notes:?}");
        assert_eq!(of("", b"Z\xfcrich \x80 \x96").0, "Zürich € –");
        let (_, notes) = of("<?xml version='1.0' encoding='koi8-r'?>", b"\xed");
        assert!(notes[0].contains("koi8-r"), "{notes:?}");
        assert_eq!(
            of("", "Zürich".as_bytes()),
            ("Zürich".to_owned(), Vec::new())
        );
    }
}
