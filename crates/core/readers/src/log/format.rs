//! The formats of logs.

use serde::{Deserialize, Serialize};

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
