#![doc = include_str!("../README.md")]

mod auxiliary_xml;
mod control_points;
mod corners_error;
mod dem_file;
mod geojson_system;
pub mod georeferencer;
mod geotiff;
mod grid_columns;
mod map_error;
mod map_file;
mod map_options;
mod mosaic;
mod overlay;
mod place_beside;
#[cfg(test)]
mod place_beside_tests;
pub mod systems;
pub mod terrain;
pub mod tiff;
pub mod web_tiles;

pub use control_points::places_in_degrees;
pub use corners_error::CornersError;
pub use dem_file::open_dem;
pub use geotiff::{GeoKeys, GeoTiff, GeoTiffError, GeoTiffFile, MapMemory};
pub use map_error::MapFileError;
pub use map_file::{OpenMap, open_map, open_map_with};
pub use map_options::MapOptions;
pub use mosaic::Mosaic;
pub use pilotage_base::{bytes, files, frames};
pub use place_beside::with_world_file;
