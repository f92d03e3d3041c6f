//! A host that answers every job at once from a small invented flight.
#![allow(dead_code, reason = "each test file uses its own part")]

pub mod flight;
pub mod harness;
pub mod host;

pub use flight::{flight, mission, run, run_head};
pub use harness::{Rig, rig, rig_on};
pub use host::ScriptedHost;
