//! A landmark that nobody picked by hand.

use serde::{Deserialize, Serialize};

use crate::GenericClass;
use pilotage_base::frames::GroundPoint;

/// A generic landmark of a map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GenericLandmark {
    /// Its middle, world metres.
    pub place: GroundPoint,
    /// Its class.
    pub class: GenericClass,
    /// Side of a square of its area, metres.
    pub size: f64,
    /// Direction of its longer axis, radians clockwise from north, from 0 to less than π.
    pub orientation: f64,
    /// Probability that it is there and of its class, 0 to 1.
    pub confidence: f64,
    /// Probability that it is seen on another day, 0 to 1.
    pub stability: f64,
}
