//! Stretch of a map's picture.

use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize};

/// A stretch without change of area that takes the map's ground to the real one.
///
/// An orthophoto whose pixels are not as square as its georeference says, or that was made from a tilted
/// reconstruction, shows the ground so: a compass would notice nothing, a camera does. It is the
/// exponential of the symmetric matrix [`along`, `across`; `across`, -`along`] on (north, east).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MapShape {
    /// Half the logarithm of the stretch of north against east.
    pub along: f64,
    /// The same of north-east against north-west.
    pub across: f64,
}

impl MapShape {
    /// The matrix that takes (north, east) on the map to (north, east) on the ground, both from one point.
    ///
    /// ```
    /// use nalgebra::Vector2;
    /// use pilotage_vision::registration::MapShape;
    ///
    /// // 10 m north on the map are e^0.01 times as much on the ground, 10 m east as many times less.
    /// let shape = MapShape { along: 0.01, across: 0.0 };
    /// let on_ground = shape.ground_from_map() * Vector2::new(10.0, 10.0);
    /// assert!((on_ground.x - 10.0 * 0.01_f64.exp()).abs() < 1e-12);
    /// assert!((on_ground.y - 10.0 * (-0.01_f64).exp()).abs() < 1e-12);
    /// ```
    pub fn ground_from_map(&self) -> Matrix2<f64> {
        self.exponential(1.0)
    }

    /// Its inverse.
    pub fn map_from_ground(&self) -> Matrix2<f64> {
        self.exponential(-1.0)
    }

    /// exp(tA) = cosh(tr) + sinh(tr) A / r for A² = r².
    fn exponential(&self, sign: f64) -> Matrix2<f64> {
        let r = self.along.hypot(self.across);
        let share = if r > 0.0 { sign * r.sinh() / r } else { sign };
        Matrix2::identity() * r.cosh()
            + Matrix2::new(self.along, self.across, self.across, -self.along) * share
    }

    /// Ratio of the longest to the shortest stretch.
    pub fn ratio(&self) -> f64 {
        (2.0 * self.along.hypot(self.across)).exp()
    }

    /// Direction along which a metre of the map is longest on the ground, radians clockwise from north,
    /// 0 to π.
    pub fn direction(&self) -> f64 {
        (0.5 * self.across.atan2(self.along)).rem_euclid(std::f64::consts::PI)
    }

    /// A vector on the map as it is on the ground, (north, east).
    pub fn to_ground(&self, on_map: &Vector2<f64>) -> Vector2<f64> {
        self.ground_from_map() * on_map
    }
}
