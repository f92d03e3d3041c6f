//! A kind of message, as the log announces it.

use super::super::FieldKind;
use super::letters::Letter;

/// Bytes before the fields of a message: two marks and its number.
pub const HEADER: usize = 3;
/// Number of the message that announces others.
pub const FORMAT: u8 = 0x80;
/// Bytes of its fields.
const FORMAT_BODY: usize = 86;

/// A kind of message: what its number, its name and its fields are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MessageFormat {
    /// Number in the header.
    pub number: u8,
    /// Bytes after the header.
    pub length: usize,
    /// Name, up to four letters.
    pub name: String,
    /// A letter for each field.
    pub letters: Vec<u8>,
    /// Names of the fields.
    pub columns: Vec<String>,
}

/// A field of a message.
#[derive(Clone, Debug, PartialEq)]
pub struct MessageField {
    /// Its name.
    pub name: String,
    /// Meaning of its letter.
    pub letter: Letter,
    /// First byte after the header.
    pub offset: usize,
}

impl MessageFormat {
    /// The announcement of announcements, which logs repeat but need not.
    pub fn of_formats() -> Self {
        Self {
            number: FORMAT,
            length: FORMAT_BODY,
            name: "FMT".to_owned(),
            letters: b"BBnNZ".to_vec(),
            columns: names("Type,Length,Name,Format,Columns"),
        }
    }

    /// Reads an announcement, from the bytes after its header.
    ///
    /// # Errors
    /// In words, if it cannot be one.
    pub fn read(body: &[u8]) -> Result<Self, String> {
        let &[number, length, ref texts @ ..] = body else {
            return Err("an announcement is too short".to_owned());
        };
        let text = |kind: FieldKind, at: usize| texts.get(at..).and_then(|b| kind.text(b));
        let format = || {
            let name = text(FieldKind::Text(4), 0)?;
            let letters = text(FieldKind::Text(16), 4)?;
            let columns = text(FieldKind::Text(64), 20)?;
            Some(Self::new(
                number,
                usize::from(length),
                name,
                &letters,
                &columns,
            ))
        };
        format().ok_or_else(|| "an announcement is too short".to_owned())?
    }

    /// A kind of message of `length` bytes with its header.
    ///
    /// # Errors
    /// In words, if there can be no such kind.
    pub fn new(
        number: u8,
        length: usize,
        name: String,
        letters: &str,
        columns: &str,
    ) -> Result<Self, String> {
        let is_word = |text: &str| text.bytes().all(|b| b.is_ascii_graphic());
        if name.is_empty() || !is_word(&name) || !is_word(letters) {
            return Err(format!(
                "the announcement of message {number} is unreadable"
            ));
        }
        let Some(length) = length.checked_sub(HEADER) else {
            return Err(format!("{name}: announced with a length of {length} bytes"));
        };
        Ok(Self {
            number,
            length,
            name,
            letters: letters.as_bytes().to_vec(),
            columns: names(columns),
        })
    }

    /// The fields that can be told apart: those whose letters are known and that fit into the message.
    /// Beside them the bytes that they take.
    pub fn fields(&self) -> (Vec<MessageField>, usize) {
        let mut offset = 0;
        let mut columns = Vec::new();
        for (i, letter) in self.letters.iter().enumerate() {
            let Some(mut letter) = Letter::of(*letter) else {
                break;
            };
            if offset + letter.size() > self.length {
                break;
            }
            let name = self.columns.get(i).filter(|name| !name.is_empty());
            let name = name.map_or_else(|| format!("field {}", i + 1), Clone::clone);
            if self.name == "FILE" && name == "Data" {
                // A piece of some file, which need not be letters.
                letter.kind = FieldKind::Bytes(letter.kind.size() as u16);
            }
            columns.push(MessageField {
                name,
                letter,
                offset,
            });
            offset += letter.size();
        }
        (columns, offset)
    }

    /// Bytes of its fields after the header, where each has a name and a letter that is known: another number than that
    /// which is announced, if one of both is damaged.
    pub fn length_of_fields(&self) -> Option<usize> {
        let sizes = self
            .letters
            .iter()
            .map(|letter| Some(Letter::of(*letter)?.size()));
        let total: Option<usize> = sizes.sum();
        total.filter(|total| *total > 0 && self.letters.len() == self.columns.len())
    }

    /// Oddity of the announcement, in words; `None` if fields and length agree.
    pub fn oddity(&self) -> Option<String> {
        let (columns, used) = self.fields();
        let name = &self.name;
        if let Some(letter) = self.letters.get(columns.len()) {
            let letter = char::from(*letter);
            return Some(if Letter::of(letter as u8).is_some() {
                format!("{name}: its fields need more bytes than it has; the last are left out")
            } else {
                format!(
                    "{name}: the letter {letter} for a field is not known; the rest stays bytes"
                )
            });
        }
        let rest = self.length - used;
        (rest > 0).then(|| format!("{name}: {rest} bytes after its last field"))
    }
}

fn names(columns: &str) -> Vec<String> {
    let names = columns.split(',').map(|name| name.trim().to_owned());
    if columns.is_empty() {
        Vec::new()
    } else {
        names.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn format(length: usize, letters: &str, columns: &str) -> MessageFormat {
        MessageFormat::new(7, length, "ATT".to_owned(), letters, columns).unwrap()
    }

    #[test]
    fn fields_stand_one_behind_the_other() {
        let (columns, used) = format(3 + 8 + 64 + 2, "Qac", "TimeUS,Data,Roll").fields();
        let offsets: Vec<_> = columns
            .iter()
            .map(|c| (c.name.as_str(), c.offset))
            .collect();
        assert_eq!(offsets, [("TimeUS", 0), ("Data", 8), ("Roll", 72)]);
        assert_eq!(used, 74);
    }

    #[test]
    fn what_does_not_fit_is_left_out_and_said() {
        let short = format(3 + 3, "BIB", "a,b,c");
        assert_eq!(short.fields().0.len(), 1);
        assert!(short.oddity().unwrap().contains("more bytes"));
        let strange = format(3 + 6, "B?I", "a,b,c");
        assert_eq!(strange.fields().1, 1);
        assert!(strange.oddity().unwrap().contains("letter ?"));
        let long = format(3 + 6, "B", "a");
        assert!(long.oddity().unwrap().contains("5 bytes"));
        assert_eq!(format(3 + 1, "B", "a").oddity(), None);
    }

    #[test]
    fn names_that_are_missing_are_numbers() {
        let (columns, _) = format(3 + 3, "BBB", "a,").fields();
        let names: Vec<_> = columns.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["a", "field 2", "field 3"]);
    }

    #[test]
    fn what_cannot_be_an_announcement_is_none() {
        assert!(MessageFormat::read(&[1, 2, 3]).is_err());
        let mut body = vec![7, 2, b'A', b'T', b'T', 0];
        body.resize(86, 0);
        assert!(
            MessageFormat::read(&body)
                .unwrap_err()
                .contains("length of 2")
        );
        body[1] = 3;
        assert_eq!(MessageFormat::read(&body).unwrap().length, 0);
        body[2] = 9;
        assert!(
            MessageFormat::read(&body)
                .unwrap_err()
                .contains("unreadable")
        );
    }
}
