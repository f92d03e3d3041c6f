//! Every format that logs are read from.

use super::format::log_formats;
use super::{LogFormat, LogFormatInfo};
use crate::role::Meaning;

/// Makes the table of readers, and apart from it that of meanings.
macro_rules! works {
    ($($(#[$about:meta])* $name:ident($label:literal, $ending:literal, $folder:ident $info:ident),)*) => {
        /// Every format, in the order in which they are tried.
        pub fn all_formats() -> &'static [LogFormatInfo] {
            &[$(super::$folder::$info,)*]
        }

        impl LogFormat {
            /// Meaning of its topics for a flight.
            pub(crate) fn meaning(self) -> Meaning {
                match self {
                    $(Self::$name => super::$folder::MEANING,)*
                    Self::Tables | Self::Photos => Meaning {
                        roles: &[],
                        triggers: &[],
                        conditions: &[],
                    },
                }
            }
        }
    };
}

log_formats!(works);

/// First bytes of a file that are enough to recognise it: logs that are text may begin with some lines of
/// talk.
pub const HEAD: usize = 4096;

/// The format of a file whose first bytes are `head`, [`HEAD`] of them or all that there are. Its name is
/// not asked: people rename files.
pub fn recognise(head: &[u8]) -> Option<&'static LogFormatInfo> {
    all_formats().iter().find(|info| (info.begins)(head))
}
