//! Projection of points of the world into the picture, and back.

mod distortion;
mod footprint;
mod jacobian;
mod model;
mod posed;
mod rays;
#[cfg(test)]
mod tests;

pub use distortion::Distortion;
pub use footprint::FARTHEST_HEIGHTS;
pub use model::{CameraModel, Lens, Mount, UNSTATED_MOUNT_DEVIATION};
pub use posed::PosedCamera;
pub use rays::RayTable;
