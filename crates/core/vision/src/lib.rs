//! Observations by the camera, found on the map: landmarks and their detectors, whole frames registered, roads, and
//! errors of the camera's pose as they become errors in the picture.

mod evidence;
pub mod geometry;
pub mod ground_class;
pub mod landmark;
pub mod registration;
pub mod road;
pub mod straight_edge;
mod texture;
