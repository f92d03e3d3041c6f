//! `ArduPilot`'s dataflash logs.
//!
//! Each message is two marks, the number of its kind, and fields. FMT messages announce kinds: their length,
//! their name, a letter for each field, and the fields' names. FMTU, UNIT and MULT say what units and which
//! multipliers the fields have, and which of them tells instances apart.
//!
//! The same messages may stand in lines of text ([`DataflashTextReader`]); their rows are those that the
//! binary log would have.

mod binary;
mod clock;
mod contents;
mod format;
mod letters;
mod roles;
#[cfg(test)]
mod tests;
mod text;
mod topics;
mod units;
mod values;
mod words;

pub use binary::{DataflashReader, begins};
pub(super) use roles::MEANING;
pub use text::{DataflashTextReader, begins as text_begins};

use super::{LogFormat, LogFormatInfo};

/// The binary format.
pub(super) const BINARY: LogFormatInfo = LogFormatInfo {
    format: LogFormat::Dataflash,
    begins,
    reader: || Box::new(DataflashReader::new()),
};

/// The same as text.
pub(super) const TEXT: LogFormatInfo = LogFormatInfo {
    format: LogFormat::DataflashText,
    begins: text_begins,
    reader: || Box::new(DataflashTextReader::new()),
};
