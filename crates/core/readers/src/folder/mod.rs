//! The flight folder: flight.json, channels and truth as CSV with a column map, frames as pictures.
//!
//! docs/formats.md defines it.

mod bare_angles;
mod channels;
mod clock;
mod error;
mod files;
mod fit_rows;
mod guess;
pub(crate) mod hemispheres;
mod layout;
mod letter_o;
mod log;
mod pictures;
mod position;
mod read;
mod receiver_dates;
mod receivers;
mod row_lines;
mod solutions;
mod standing;
mod table;
mod table_text;
#[cfg(test)]
mod tests;
mod thousands;
mod time_unit;
mod told_clocks;
mod utc;
mod utm_places;
mod variation;
mod vbo;
mod write;

pub(super) use clock::TimeFormat;
pub use error::FolderError;
pub use files::FLIGHT_FILE;
pub(super) use layout::{
    ChannelFile, FlightFile, FramesFile, StartFile, TimeColumn, VERSION, ValueColumn,
};
pub(super) use log::of_samples;
pub use pictures::FolderFrames;
pub use read::{FlightFolder, read_flight};
pub(super) use read::{FlightOrigin, read_tables};
pub(super) use receiver_dates::RECEIVER_DATE;
pub(super) use row_lines::{decoded, rows_of_one_line};
pub(super) use solutions::are_above_ellipsoid;
pub(super) use table::{CsvTable, decoded_table};
pub use write::{WriteError, write_flight};
