//! Flight logs as they were written: topics of rows, parameters, messages, and what was skipped.
//!
//! A [`LogReader`] takes the bytes of a file piece by piece and fills a [`Log`], which can be looked at
//! while it still grows. Rows stay as the file has them and are decoded where somebody asks, so that a
//! log takes hardly more memory than its file. What the fields mean for navigation is said one folder
//! up.

#[macro_use]
mod format;

mod ardupilot_modes;
mod column;
mod formats;
mod gps_time;
mod growing;
mod layout;
mod model;
mod outline;
mod px4_modes;
mod px4_roles;
mod px4_units;
mod reader;
mod release;
mod report;
mod rows;
mod scale;
mod schema;
mod set_parameters;
mod stepping;
#[cfg(test)]
mod testing;
mod topic;
mod topic_words;
mod vehicles;
mod whole;
mod wrong_times;

pub use column::{Cells, Column};
pub use formats::{HEAD, recognise};
pub use layout::{FieldKind, FieldLayout};
pub use model::{DefaultValue, Fact, Log, LogMessage, ModeChange, Parameter};
pub use outline::{FieldOutline, LogOutline, TopicOutline};
pub use reader::{LogFormatInfo, LogReader};
pub use report::{LoggerDropout, ReadReport, Skipped};
pub use rows::Rows;
pub use scale::ValueScale;
pub use set_parameters::SetParameter;
pub use topic::{Topic, TopicName};
pub(crate) use topic_words::{TopicSubject, first_word, subject};
pub(crate) use vehicles::{is_component, system_of};
pub use whole::read_log;

// All formats: another one is a file or folder of this one with its `INFO` and its `MEANING`, and a line here.
log_formats! {
    dataflash {
        /// `ArduPilot`'s dataflash log, binary.
        Dataflash("ArduPilot dataflash", ".bin", BINARY),
        /// `ArduPilot`'s dataflash log as text.
        DataflashText("ArduPilot dataflash, text", ".log", TEXT),
    }
    ulog { Ulog("PX4 ULog", ".ulg", INFO), }
    mcap { Mcap("MCAP", ".mcap", INFO), }
    tlog { Tlog("MAVLink telemetry log", ".tlog", INFO), }
}
