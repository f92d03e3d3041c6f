//! A file as formats look at it to tell whether it is theirs.

use std::borrow::Cow;

use super::csv_bare::is_bare;
use super::csv_preface::preface;
use super::format_info::FormatInfo;

/// Bytes of a file's beginning in which formats look for their words.
const HEAD: usize = 4096;

/// Claim of a format to a file. The greatest has the file, and the first of the table among equal ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Claim {
    /// It is another's.
    None,
    /// It may be, if nobody else wants it.
    Possible,
    /// Its name says so.
    Named,
    /// Its content has what others may have as well.
    Likely,
    /// Its content has what no other has.
    Sure,
    /// It is a special kind of what others would take it for.
    Special,
}

/// Form of a file's content.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FileForm {
    Zip,
    Xml,
    Json,
    /// Any other text, or none.
    Text,
}

/// A file as formats look at it.
pub(super) struct FileLook<'a> {
    pub name: &'a str,
    pub bytes: &'a [u8],
    /// Its beginning as text, without blanks and marks before it.
    pub head: &'a str,
    pub form: FileForm,
}

impl<'a> FileLook<'a> {
    /// The beginning of a file as text.
    pub fn head(bytes: &[u8]) -> Cow<'_, str> {
        String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD)])
    }

    /// A file that begins with that text.
    pub fn new(name: &'a str, bytes: &'a [u8], head: &'a str) -> Self {
        // A sequence of GeoJSON begins with the separator of its records.
        let head = head.trim_start_matches(['\u{feff}', '\u{1e}']).trim_start();
        let form = match head.as_bytes().first() {
            _ if bytes.starts_with(b"PK\x03\x04") => FileForm::Zip,
            Some(b'<') => FileForm::Xml,
            Some(b'{') => FileForm::Json,
            _ => FileForm::Text,
        };
        Self {
            name,
            bytes,
            head,
            form,
        }
    }

    /// Whether the extension of its name tells that format.
    pub fn is_named(&self, info: &FormatInfo) -> bool {
        info.is_named(self.name)
    }

    /// Claim by the name of a text that is neither XML nor JSON.
    pub fn named_text(&self, info: &FormatInfo) -> Claim {
        match self.form {
            FileForm::Text if self.is_named(info) => Claim::Named,
            _ => Claim::None,
        }
    }

    /// Whether it begins as a table does.
    pub fn is_table(&self) -> bool {
        let first_line = preface(self.head).table.lines().next().unwrap_or("");
        [',', ';', '\t'].iter().any(|c| first_line.contains(*c)) || is_bare(self.head)
    }

    /// Whether its content, all of it, has these bytes, in letters of either case.
    pub fn has(&self, words: &[u8]) -> bool {
        let mut windows = self.bytes.windows(words.len());
        windows.any(|part| part.eq_ignore_ascii_case(words))
    }
}
