//! Programs with a disk and threads share this: files opened as flights, logs, maps and missions, and work on all
//! processors.

pub mod files;
mod filter_keys;
pub mod filter_options;
pub mod landmarks;
pub mod maps;
pub mod mission_file;
pub mod opening;
pub mod planned_flight;
pub mod predict;
mod read_files;
pub mod replaying;
pub mod workers;
