//! Foundations of every other crate of the method: frames of reference and units, where pictures lie on
//! the ground, bytes and files by name, and the distributions behind gates and intervals.
//!
//! Knows no aircraft, no picture and no file format.

pub mod angle_text;
pub mod bytes;
pub mod files;
pub mod frames;
pub mod georeference;
pub mod statistics;
pub mod text;
pub mod viridis;
