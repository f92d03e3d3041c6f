//! Flight logs: made, damaged, and what must hold of every reader whatever it reads.
//!
//! - [`dataflash`] writes logs of `ArduPilot`, binary or as text, row by row;
//! - [`made`] are whole small logs of every kind;
//! - [`mcap`] writes MCAP files with messages of every kind of schema;
//! - [`tlog`] writes `MAVLink` messages with times;
//! - [`corpus`] is what a format's reader is tried on;
//! - [`damage`] breaks logs as power cuts, bad storage and malice do;
//! - [`check`] reads a log whole and in pieces and says what is wrong with the result.

pub mod check;
pub mod corpus;
pub mod damage;
pub mod dataflash;
pub mod made;
pub mod mcap;
pub mod tlog;
