//! Generic landmarks: things of common classes that nobody picked by hand, as a compact table of a map, and the
//! association of what is seen from the air with that table.
//!
//! Second method of DeAngelo 2016 (chapter 3): buildings, fields and trees are told apart by their arrangement.

pub mod association;
mod class;
mod compact;
pub mod edges;
mod landmark;
mod pixel_table;
pub mod seeing;
mod table;

pub use class::GenericClass;
pub use compact::CompactTableError;
pub use landmark::GenericLandmark;
pub use table::ReferenceTable;
