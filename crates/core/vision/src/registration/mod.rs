//! A whole frame laid on the map: where the camera was and how it was turned, from many places of the
//! picture at once.
//!
//! A sweep compares the whole frame with the map, coarsely, at every heading, height and place that is
//! possible ([`HeadingPrior`] may know nothing). At the best of them the frame is cut into patches, each
//! of which is looked for on the map for itself; what agrees on one map of the plane determines the pose
//! by robust least squares, together with how the map is stretched ([`MapShape`]). It is believed if
//! chance cannot explain so much agreement and no other place does as well.
//!
//! Conte 2009, section 5.7, registers by the whole frame alone, with heading and height from the
//! autopilot; here they are found.

mod agreement;
mod camera_place;
mod fit;
mod follower;
mod ground;
mod look;
mod patches;
mod prior;
mod register;
mod shape;
mod sweep;
mod texture;

pub use camera_place::CameraPlace;
pub use fit::{PoseFit, UNKNOWNS};
pub use follower::{FollowSettings, Follower, Measured};
pub use look::{Look, MapPose};
pub use patches::PatchMatch;
pub use prior::{HeadingPrior, PosePrior};
pub use register::{NotRegistered, Registration, register};
pub use shape::MapShape;
