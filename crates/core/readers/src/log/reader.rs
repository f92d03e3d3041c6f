//! Readers of logs, and knowledge of them before any file is read.

use super::{Log, LogFormat};

/// Reads a log piece by piece.
///
/// Whatever the bytes are, a reader never panics and never stops for good: what makes no sense is
/// skipped up to the next place that does, and noted in the log's report.
pub trait LogReader: Send {
    /// Takes the next bytes of the file, of any number, and puts what they complete into `log`.
    fn feed(&mut self, bytes: &[u8], log: &mut Log);

    /// Says that the file is over: what was waiting for more is noted as cut off.
    fn finish(&mut self, log: &mut Log);
}

/// Knowledge of a format before any file is read.
pub struct LogFormatInfo {
    /// The format.
    pub format: LogFormat,
    /// Whether a file that begins so is of this format.
    pub begins: fn(&[u8]) -> bool,
    /// A reader at the beginning of a file.
    pub reader: fn() -> Box<dyn LogReader>,
}
