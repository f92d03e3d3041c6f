//! Every format that logs are read from.

use serde::{Deserialize, Serialize};

use super::{Log, dataflash, mcap, tlog, ulog};

/// A format of logs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum LogFormat {
    /// `ArduPilot`'s dataflash log, binary.
    Dataflash,
    /// `ArduPilot`'s dataflash log as text.
    DataflashText,
    /// PX4's `ULog`.
    Ulog,
    /// `MAVLink` messages with times, as ground stations write them.
    Tlog,
    /// MCAP, the container of Foxglove and ROS 2.
    Mcap,
    /// Tables of a flight, whose columns people or a file beside them told apart.
    Tables,
    /// Photos that say themselves when, where and how they were taken.
    Photos,
}

impl LogFormat {
    /// Name for people. Told here, beside the names, so that who only shows them needs no reader.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Dataflash => "ArduPilot dataflash",
            Self::DataflashText => "ArduPilot dataflash, text",
            Self::Ulog => "PX4 ULog",
            Self::Tlog => "MAVLink telemetry log",
            Self::Mcap => "MCAP",
            Self::Tables => "Tables",
            Self::Photos => "Photos",
        }
    }
}

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

/// What is known of a format before any file is read.
pub struct FormatInfo {
    /// Which format.
    pub format: LogFormat,
    /// Endings of its files, in small letters.
    pub endings: &'static [&'static str],
    /// Whether a file that begins so is of this format.
    pub begins: fn(&[u8]) -> bool,
    /// A reader at the beginning of a file.
    pub reader: fn() -> Box<dyn LogReader>,
}

/// Every format, in the order in which they are tried.
pub fn all_formats() -> &'static [FormatInfo] {
    &[
        FormatInfo {
            format: LogFormat::Dataflash,
            endings: &["bin"],
            begins: dataflash::begins,
            reader: || Box::new(dataflash::DataflashReader::new()),
        },
        FormatInfo {
            format: LogFormat::DataflashText,
            endings: &["log"],
            begins: dataflash::text_begins,
            reader: || Box::new(dataflash::DataflashTextReader::new()),
        },
        ulog::INFO,
        mcap::INFO,
        tlog::INFO,
    ]
}

/// First bytes of a file that are enough to recognise it: logs that are text may begin with some lines of
/// talk.
pub const HEAD: usize = 4096;

/// The format of a file whose first bytes are `head`, [`HEAD`] of them or all that there are. Its name is
/// not asked: people rename files.
pub fn recognise(head: &[u8]) -> Option<&'static FormatInfo> {
    all_formats().iter().find(|info| (info.begins)(head))
}
