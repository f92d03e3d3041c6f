//! What the camera sees, found on the map: landmarks and their detectors, whole frames registered, and
//! how errors of the camera's pose become errors in the picture.

mod evidence;
pub mod geometry;
pub mod landmark;
pub mod registration;
mod texture;
