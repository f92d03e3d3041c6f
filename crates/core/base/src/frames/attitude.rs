//! Attitude and pose of the vehicle.

use std::f64::consts::{PI, TAU};

use nalgebra::{Point3, Rotation3};
use serde::{Deserialize, Serialize};

/// The angle brought into (-π, π].
///
/// ```
/// use std::f64::consts::PI;
/// use pilotage_base::frames::wrap_pi;
///
/// // Three quarters of a turn to the right are a quarter to the left.
/// assert!((wrap_pi(1.5 * PI) + 0.5 * PI).abs() < 1e-12);
/// ```
pub fn wrap_pi(angle: f64) -> f64 {
    let wrapped = (angle + PI).rem_euclid(TAU) - PI;
    if wrapped == -PI { PI } else { wrapped }
}

/// Roll (right wing down positive), pitch (nose up positive) and yaw (clockwise from north), radians.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Attitude {
    /// Roll, radians, right wing down positive.
    pub roll: f64,
    /// Pitch, radians, nose up positive.
    pub pitch: f64,
    /// Yaw, radians, clockwise from north.
    pub yaw: f64,
}

impl Attitude {
    /// Wings level, heading `yaw` radians.
    pub fn level(yaw: f64) -> Self {
        Self {
            roll: 0.0,
            pitch: 0.0,
            yaw,
        }
    }

    /// Rotation that takes body vectors (forward-right-down) to world vectors (NED).
    ///
    /// DeAngelo 2016, eqs 34-36, transposed and with north-east-down axes.
    ///
    /// ```
    /// use nalgebra::Vector3;
    /// use pilotage_base::frames::Attitude;
    ///
    /// // Heading east, level: forward is east and the right wing points south.
    /// let attitude = Attitude::level(90_f64.to_radians());
    /// let world_from_body = attitude.world_from_body();
    /// let (forward, right) = (world_from_body * Vector3::x(), world_from_body * Vector3::y());
    /// assert!((forward - Vector3::new(0.0, 1.0, 0.0)).norm() < 1e-12);
    /// assert!((right - Vector3::new(-1.0, 0.0, 0.0)).norm() < 1e-12);
    /// ```
    pub fn world_from_body(&self) -> Rotation3<f64> {
        Rotation3::from_euler_angles(self.roll, self.pitch, self.yaw)
    }
}

/// Position and attitude of the vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Position in world NED, metres (down is negative above the origin's level).
    pub position_in_world: Point3<f64>,
    /// Attitude of the body.
    pub attitude: Attitude,
}
