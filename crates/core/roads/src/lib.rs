//! Road maps: graphs of curved centre lines with widths, classes and crossings.

mod course;
mod line;
mod map;
mod segments;
mod weave;

pub use course::{CoursePlace, course_length, place_along, place_near};
pub use line::{RoadClass, RoadLine};
pub use map::{RoadCrossing, RoadEdge, RoadMap};
pub use segments::NearRoad;
pub use weave::RoadJoining;
