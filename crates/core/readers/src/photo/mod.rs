//! Photos that say where, when and how they were taken, and the flight that a folder of them tells of.
//!
//! Of a JPEG file the head is read, of a PNG the chunks beside its pixels, of a TIFF the tags, which are the same: EXIF 2.32
//! (CIPA DC-008), of which the tags about time, place and focal length count, and XMP, in which camera drones write the
//! attitude of gimbal and aircraft. The crate `kamadak-exif` adds 9 kB to a WebAssembly program and gives up a photo at the
//! first tag that makes no sense; the reader here is our own.

mod camera;
mod exif;
mod flight;
mod head;
mod laying;
mod lenses;
mod log;
#[cfg(test)]
mod makers_tests;
mod place;
mod png;
#[cfg(test)]
mod png_tests;
mod pose;
mod read;
mod search;
mod tabled;
#[cfg(test)]
mod tests;
mod timed;
mod triggered;
#[cfg(test)]
mod triggered_tests;
mod triggers;
mod xmp;

pub use camera::{focal_in_pixels, told_focal};
pub use flight::{photos_lack, read_photos, read_tabled_photos};
pub use laying::{DecodePhoto, PhotoAnswer, PhotoLook, RegisteredPhoto};
pub use place::{PhotoPlace, PhotoPlaceSource};
pub use pose::{PhotoPose, photo_pose};
pub use read::{Photo, PhotoError, read_photo};
pub use search::PhotoSearch;
pub use tabled::{PhotoRow, PhotoRows};
pub use triggered::{PlacedPhotos, add_photos};
pub use triggers::{Triggers, triggers};
