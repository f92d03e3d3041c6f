//! How points of the world come to lie in the picture, and back.

mod model;

pub use model::{CameraModel, Distortion, Lens, Mount};
