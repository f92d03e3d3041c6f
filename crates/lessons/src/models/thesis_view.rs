//! The landmark and the aircraft of the lessons on the thesis' measurement chain.

use nalgebra::{Point3, Vector3};
use pilotage_base::frames::{Attitude, Pose};

/// Landmark, metres north, east, down.
pub const LANDMARK: [f64; 3] = [245.0, 130.0, 0.0];
/// Aircraft over the ground, metres north and east.
pub const AIRCRAFT: [f64; 2] = [200.0, 100.0];
/// Height above the ground, metres.
pub const HEIGHT: f64 = 300.0;

/// Pose of the aircraft at a height above the ground, with angles in degrees.
pub fn pose_at(height: f64, [roll, pitch, yaw]: [f64; 3]) -> Pose {
    Pose {
        position_in_world: Point3::new(AIRCRAFT[0], AIRCRAFT[1], -height),
        attitude: Attitude {
            roll: roll.to_radians(),
            pitch: pitch.to_radians(),
            yaw: yaw.to_radians(),
        },
    }
}

/// A point of the world from the aircraft, in axes turned by an attitude: ahead, right, down, metres.
pub fn seen_from(pose: &Pose, attitude: &Attitude, point: &Point3<f64>) -> Vector3<f64> {
    attitude.world_from_body().inverse() * (point - pose.position_in_world)
}
