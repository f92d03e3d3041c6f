//! A whole frame laid on the map: where the camera was and how it was turned, from many places of the
//! picture at once.
//!
//! A sweep correlates the whole frame's orientation field with the map's, coarsely, at every heading, height
//! and place that is possible ([`HeadingPrior`] may know nothing), and tells how probable each is. The best of
//! them are brought to the top of their summits. Where map and frame are of the same days, small patches are
//! found again for themselves, and determine the pose to centimetres by robust least squares, together with how
//! the map is stretched ([`MapShape`]); they are believed if chance cannot explain so much agreement and no
//! other place does as well. Where they are not, the whole frame is believed by its probability.
//!
//! Conte 2009, section 5.7, registers by the whole frame alone, with heading and height from the
//! autopilot; here they are found.

mod agreement;
mod camera_place;
mod contrast;
mod drape;
mod edges;
mod fit;
mod follower;
mod grid;
mod ground;
mod guess;
#[cfg(test)]
mod laid_for_tests;
mod lattice;
mod limits;
mod look;
mod overlay;
mod patches;
mod prior;
#[cfg(test)]
mod prior_for_tests;
mod register;
mod shape;
mod summit;
mod sweep;
mod weighed;

use crate::evidence;

pub use camera_place::CameraPlace;
pub use drape::{Draped, drape, outline};
pub use evidence::Evidence;
pub use fit::{PoseFit, UNKNOWNS};
pub use follower::{FollowSettings, Follower, InstrumentReadings, USUAL_MAP_DEVIATION};
pub use guess::PoseGuess;
pub use limits::{deviation_within, limit_of, log_deviation_within, share_of};
pub use look::{FrameLook, MapPose};
pub use overlay::overlay;
pub use patches::PatchMatch;
pub use prior::{HeadingPrior, PosePrior, StoredTurn};
pub use register::{
    FrameSighting, NotRegistered, Registration, RegistrationMethod, register, sight,
};
pub use shape::MapShape;
pub use sweep::sweep;
