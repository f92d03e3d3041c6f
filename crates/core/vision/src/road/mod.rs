//! Roads in pictures of the ground: where they run, how wide they are, where they meet.
//!
//! Pixels have x right, y down, their origin at the outer corner of the top-left pixel.

mod bends;
mod crossing;
mod detection;
mod distance;
mod following;
pub mod network;
mod north_up;
mod probability;
mod ridge;
mod seen;
mod trace;
pub mod yellow;

pub use detection::RoadDetection;
pub use following::{NotFollowed, RoadFollowing, RoadOnGround};
pub use north_up::NorthUpPicture;
pub use probability::{
    COARSEST_SEEN, RoadProbability, SEEN_GSD, probability_by, road_probability, roads_seen,
};
pub use ridge::road_mask;
pub use seen::{RoadPoint, RoadsSeen, SeenCrossing};
pub use trace::{RoadTrace, TracedRoad};
