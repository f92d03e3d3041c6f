//! The flight folder: flight.json, channels and truth as CSV with a column map, frames as pictures.
//!
//! docs/formats.md defines it.

mod channels;
mod clock;
mod date;
mod error;
mod guess;
mod layout;
mod log;
mod moment;
mod pictures;
mod position;
mod read;
mod table;
#[cfg(test)]
mod tests;
mod time_unit;
mod units;
mod write;

pub(super) use clock::TimeFormat;
pub(super) use date::{date_and_time, days_since_1970, readings};
pub use error::FolderError;
pub(super) use layout::{
    ChannelFile, FlightFile, FramesFile, StartFile, TimeColumn, VERSION, ValueColumn,
};
pub(super) use log::of_samples;
pub(super) use moment::Moment;
pub use pictures::FolderFrames;
pub use read::{FLIGHT_FILE, FlightFolder, read_flight};
pub(super) use read::{Told, read_tables};
pub(super) use table::{Table, decoded};
pub(super) use units::{DEGREES_AND_MINUTES, Dimension, linear};
pub use write::{WriteError, write_flight};
