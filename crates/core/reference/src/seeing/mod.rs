//! Generic landmarks seen in classes of the ground: in a picture from the air, or in the map.

mod blobs;
mod mapping;
mod observed;
mod picture_view;
mod precision;
#[cfg(test)]
mod tests;
mod things;

pub use mapping::{LookAtTile, ReferenceMapping, SeenTiles};
pub use observed::ground_by_pose;
pub use picture_view::PictureView;
pub use precision::{GROUP_SIZES, size_group};
pub use things::landmarks_seen;
