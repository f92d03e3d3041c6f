//! The views and commands of Pilotage, without a window system, so that tests drive them natively.

pub mod command;
pub mod context;
pub mod host;
pub mod jobs;
pub mod tokens;
pub mod units;
