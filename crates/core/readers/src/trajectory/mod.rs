//! Distance of one trajectory from another, as evo (Grupp 2017) defines it.

mod alignment;
mod comparison;
mod error;
mod statistics;
mod track;

pub use alignment::{TrajectoryAlignment, TrajectorySimilarity, align};
pub use comparison::{
    ClockRelation, ComparisonSettings, NotComparable, TrajectoryComparison, compare, shift_to,
};
pub use error::{Delta, PlacePair, absolute_errors, associate, place_at, relative_errors};
pub use statistics::ErrorStatistics;
pub use track::Trajectory;

use nalgebra::Point3;
use serde::{Deserialize, Serialize};

/// A place at a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TimedPlace {
    /// Seconds.
    pub time: f64,
    /// World NED, metres.
    pub place: Point3<f64>,
}
