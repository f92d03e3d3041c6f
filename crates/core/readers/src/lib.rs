//! Flights read from what other programs recorded: flight folders and tables, logs of autopilots and
//! robots, photos and films; what their columns and topics mean; and a flight at a glance.
//!
//! Every reader takes bytes, reports what it skipped, and never panics.

pub mod beside_log;
pub mod columns;
pub mod expression;
mod folder;
pub mod interpret;
pub mod log;
pub mod overview;
pub mod photo;
pub mod role;
mod span_statistics;
mod span_table;
pub mod trajectory;
pub mod video;

pub use folder::{
    FLIGHT_FILE, FlightFolder, FolderError, FolderFrames, WriteError, read_flight, write_flight,
};
pub use span_statistics::SpanStatistics;
pub use span_table::SpanTable;
