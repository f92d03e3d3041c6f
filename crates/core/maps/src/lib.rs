#![doc = include_str!("../README.md")]

pub mod georeferencer;
mod geotiff;
mod map_file;
pub mod terrain;
pub mod tiff;
pub mod web_tiles;

pub use geotiff::{GeoKeys, GeoTiff, GeoTiffError, GeoTiffFile, MapMemory};
pub use map_file::{MapError, MapOptions, OpenMap, open_map, open_map_with};
pub use pilotage_base::{bytes, files, frames};
