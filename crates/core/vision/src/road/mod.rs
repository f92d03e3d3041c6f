//! Roads in pictures of the ground: where they run, how wide they are, where they meet.
//!
//! Pixels have x right, y down, their origin at the outer corner of the top-left pixel.

mod detection;
mod seen;
pub mod yellow;

pub use detection::RoadDetection;
pub use seen::{RoadPoint, RoadsSeen, SeenCrossing};
