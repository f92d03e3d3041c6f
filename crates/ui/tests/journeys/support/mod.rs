//! A host that answers every job at once from a small invented flight.
#![allow(dead_code, reason = "each test file uses its own part")]

pub mod canvas;
pub mod flight;
mod followed;
pub mod harness;
mod heights;
pub mod host;
pub mod inline;
pub mod laid;
#[path = "../../../src/testing/canvas.rs"]
pub mod painted;
pub mod real;
pub mod tile;
pub mod written;

pub use harness::{Rig, rig, rig_on};
pub use host::{Ahead, Pointing, Scheme, ScriptedHost};
