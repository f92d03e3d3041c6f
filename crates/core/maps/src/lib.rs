//! Maps out of files: `GeoTIFF` of any size, archives of web tiles, pictures beside a world file or put on
//! the ground by hand, and the height of the ground.
//!
//! Every source is read by pieces with bounded memory, and reports what it could not read.

pub mod georeferencer;
mod geotiff;
mod map_file;
pub mod terrain;
pub mod tiff;
pub mod web_tiles;

pub use geotiff::{GeoKeys, GeoTiff, GeoTiffError, GeoTiffFile, MapMemory};
pub use map_file::{MapError, MapOptions, OpenMap, open_map, open_map_with};
