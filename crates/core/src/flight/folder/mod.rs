//! The flight folder: flight.json, channels and truth as CSV with a column map, frames as pictures.
//!
//! docs/formats.md defines it.

mod channels;
mod clock;
mod error;
mod guess;
mod layout;
mod pictures;
mod position;
mod read;
mod table;
#[cfg(test)]
mod tests;
mod units;
mod write;

pub use error::FolderError;
pub(crate) use layout::{CameraFile, OriginFile};
pub use pictures::FolderFrames;
pub use read::{FLIGHT_FILE, FlightFolder, read_flight};
pub use write::{WriteError, write_flight};
