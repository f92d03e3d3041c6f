//! A file that was written.

/// Contents of a file for another program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrittenFile {
    /// Its contents.
    pub bytes: Vec<u8>,
    /// Notes on all that was assumed or left out, in sentences for people.
    pub notes: Vec<String>,
}

impl WrittenFile {
    /// A text with notes.
    pub(super) fn of_text((text, notes): (String, Vec<String>)) -> Self {
        let bytes = text.into_bytes();
        Self { bytes, notes }
    }
}
