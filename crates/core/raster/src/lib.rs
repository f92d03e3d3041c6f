//! Pictures, the cameras that take them, and whatever can be a map.
//!
//! Folders from the bottom up: pictures and their kernels, cameras, imagery.

pub mod camera;
pub mod imagery;
pub mod raster;
