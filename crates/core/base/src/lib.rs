//! Foundations of every other crate of the method: frames of reference and units, where pictures lie on
//! the ground, bytes and files by name, and the distributions behind gates and intervals.
//!
//! Knows no aircraft and no picture, and of file formats only what maps and photos share.

pub mod angle_text;
pub mod bytes;
pub mod files;
pub mod frames;
pub mod gazetteer;
pub mod georeference;
pub mod hemisphere_in_name;
pub mod loose_json;
pub mod place_text;
pub mod separator;
pub mod sorting;
pub mod statistics;
pub mod text;
pub mod tiff_entry;
pub mod varint;
pub mod viridis;
