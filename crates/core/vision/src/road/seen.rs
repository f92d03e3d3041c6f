//! Roads as they are seen in a picture.

use serde::{Deserialize, Serialize};

/// A point on the centre line of a road.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RoadPoint {
    /// Place (x, y), pixels.
    pub pixel: [f64; 2],
    /// Direction of the road, radians clockwise from the picture's up (north where north is up), in [0, π).
    pub direction: f64,
    /// Width of the road, pixels.
    pub width: f64,
    /// Probability that a road is there.
    pub probability: f64,
}

/// A place where roads meet or cross.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeenCrossing {
    /// Place (x, y), pixels.
    pub pixel: [f64; 2],
    /// Directions in which roads leave, radians clockwise from the picture's up, in [0, 2π), ascending.
    pub directions: Vec<f64>,
    /// Probability that roads meet there.
    pub probability: f64,
}

/// Roads of one picture.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RoadsSeen {
    /// Points along the centre lines, in no order.
    pub points: Vec<RoadPoint>,
    /// Places where roads meet.
    pub crossings: Vec<SeenCrossing>,
}

/// Direction of the vector (x, y) of pixels, radians clockwise from up, in [0, 2π).
pub(super) fn outward(x: f64, y: f64) -> f64 {
    libm::atan2(x, -y).rem_euclid(std::f64::consts::TAU)
}

/// Direction of a line along (x, y), radians clockwise from up, in [0, π).
pub(super) fn along(x: f64, y: f64) -> f64 {
    let direction = outward(x, y) % std::f64::consts::PI;
    if direction < std::f64::consts::PI {
        direction
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

    #[test]
    fn directions_turn_clockwise_from_up() {
        for (x, y, direction) in [
            (0.0, -1.0, 0.0),
            (1.0, 0.0, FRAC_PI_2),
            (0.0, 2.0, PI),
            (-1.0, -1.0, 7.0 * FRAC_PI_4),
        ] {
            assert!((outward(x, y) - direction).abs() < 1e-12, "{x}, {y}");
        }
        assert!((along(-1.0, -1.0) - 3.0 * FRAC_PI_4).abs() < 1e-12);
        assert!(along(0.0, 3.0).abs() < 1e-12);
    }
}
