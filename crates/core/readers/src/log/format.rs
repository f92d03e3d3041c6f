//! The table of the formats of logs. Another one is a folder with its `INFO` and its `MEANING`, its module, and a line here.

use serde::{Deserialize, Serialize};

/// Hands the table to a macro. Each line has the name for people, the ending of its files' names in small letters, the
/// folder, and the folder's constant that knows the reader; the order is that in which formats are tried.
macro_rules! log_formats {
    ($make:ident) => {
        $make! {
            /// `ArduPilot`'s dataflash log, binary.
            Dataflash("ArduPilot dataflash", ".bin", dataflash BINARY),
            /// `ArduPilot`'s dataflash log as text.
            DataflashText("ArduPilot dataflash, text", ".log", dataflash TEXT),
            /// PX4's `ULog`.
            Ulog("PX4 ULog", ".ulg", ulog INFO),
            /// MCAP, the container of Foxglove and ROS 2.
            Mcap("MCAP", ".mcap", mcap INFO),
            /// `MAVLink` messages with times, as ground stations write them.
            Tlog("MAVLink telemetry log", ".tlog", tlog INFO),
        }
    };
}

/// Makes the enum: who only shows names needs no reader.
macro_rules! names {
    ($($(#[$about:meta])* $name:ident($label:literal, $ending:literal, $folder:ident $info:ident),)*) => {
        /// A format of logs.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
        pub enum LogFormat {
            $($(#[$about])* $name,)*
            /// Tables of a flight, whose columns people or a file beside them told apart.
            Tables,
            /// Photos that say themselves when, where and how they were taken.
            Photos,
        }

        impl LogFormat {
            /// Endings of the names of logs, in the order of their formats.
            ///
            /// ```
            /// # use pilotage_readers::log::LogFormat;
            /// assert_eq!(LogFormat::ENDINGS.join(", "), ".bin, .log, .ulg, .mcap, .tlog");
            /// ```
            pub const ENDINGS: &[&str] = &[$($ending,)*];

            /// Name for people.
            pub const fn label(self) -> &'static str {
                match self {
                    $(Self::$name => $label,)*
                    Self::Tables => "Tables",
                    Self::Photos => "Photos",
                }
            }
        }
    };
}

log_formats!(names);

pub(super) use log_formats;
