//! Road maps: graphs of curved centre lines with widths, classes and crossings.

mod apls;
mod course;
pub mod files;
mod fix;
#[cfg(test)]
mod fix_tests;
mod line;
pub mod lost;
mod map;
mod repeats;
mod segments;
mod shared;
mod straight;
mod weave;

pub use apls::{AplsEdge, AplsGraph, AplsScore, AplsSettings, apls};
pub use course::{CoursePlace, course_length, nearest_share, place_along, place_near, thinned};
pub use fix::{RoadComponent, RoadFix, RoadFixSettings, RoadSighting, fix_on_roads};
pub use line::{RoadClass, RoadLine};
pub use map::{RoadCrossing, RoadEdge, RoadMap};
pub use repeats::without_known;
pub use segments::NearRoad;
pub use shared::{RoadsMark, SharedRoads};
pub use straight::StraightRoad;
pub use weave::RoadJoining;
