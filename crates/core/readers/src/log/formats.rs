//! Every format that logs are read from.

use super::{FormatInfo, LogFormat, dataflash, mcap, tlog, ulog};

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
