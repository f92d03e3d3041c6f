#![doc = include_str!("../README.md")]

pub mod beside_log;
mod cells;
pub mod columns;
pub mod expression;
mod folder;
pub mod foreign;
mod gimbal;
pub mod gpmf;
pub mod igc;
pub mod interpret;
pub mod log;
pub mod mat;
pub mod nmea;
mod nmea_receivers;
mod nmea_velocity;
pub mod overview;
pub mod photo;
pub mod role;
mod span_statistics;
mod span_table;
pub mod srt;
mod text_tables;
mod times;
pub mod track_files;
mod track_xml;
pub mod trajectory;
pub mod video;

pub use folder::{
    FLIGHT_FILE, FlightFolder, FolderError, FolderFrames, WriteError, read_flight, write_flight,
};
pub use pilotage_base::bytes;
pub use span_statistics::SpanStatistics;
pub use span_table::SpanTable;
