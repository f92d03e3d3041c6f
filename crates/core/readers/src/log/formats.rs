//! The format of a log, told by its first bytes.

use super::{LogFormatInfo, all_formats};

/// First bytes of a file that are enough to recognise it: logs that are text may begin with some lines of
/// talk.
pub const HEAD: usize = 4096;

/// The format of a file whose first bytes are `head`, [`HEAD`] of them or all that there are. Its name is
/// not asked: people rename files.
pub fn recognise(head: &[u8]) -> Option<&'static LogFormatInfo> {
    all_formats().iter().find(|info| (info.begins)(head))
}
