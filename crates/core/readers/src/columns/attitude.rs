//! Attitudes out of quaternions, whichever axes they are between.

use nalgebra::{Quaternion, UnitQuaternion};
use pilotage_base::frames::Attitude;

/// The attitude that a quaternion of parts w, x, y, z stands for; `None` if it is none (its norm is not near 1).
///
/// The quaternion turns body axes (forward, right, down) into north, east, down; where `is_ros`, body axes (forward,
/// left, up) into east, north, up.
pub(super) fn attitude([w, x, y, z]: [f64; 4], is_ros: bool) -> Option<Attitude> {
    let quaternion = Quaternion::new(w, x, y, z);
    let norm = quaternion.norm();
    if !(0.9..1.1).contains(&norm) {
        return None;
    }
    let (roll, pitch, yaw) = UnitQuaternion::from_quaternion(quaternion).euler_angles();
    // Turning both frames by half a turn (about forward, and about north-east) negates pitch and turns yaw around.
    let (pitch, yaw) = if is_ros {
        (-pitch, std::f64::consts::FRAC_PI_2 - yaw)
    } else {
        (pitch, yaw)
    };
    Some(Attitude { roll, pitch, yaw })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_climb_towards_the_east_is_the_same_in_both_kinds_of_axes() {
        let (roll, pitch, yaw) = (0.2, 0.3, std::f64::consts::FRAC_PI_2 + 0.1);
        let ned = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
        let ros =
            UnitQuaternion::from_euler_angles(roll, -pitch, std::f64::consts::FRAC_PI_2 - yaw);
        for (quaternion, is_ros) in [(ned, false), (ros, true)] {
            let q = quaternion.quaternion();
            let found = attitude([q.w, q.i, q.j, q.k], is_ros).unwrap();
            assert!((found.roll - roll).abs() < 1e-12);
            assert!((found.pitch - pitch).abs() < 1e-12);
            assert!((found.yaw - yaw).abs() < 1e-12);
        }
        assert_eq!(attitude([0.1, 0.0, 0.0, 0.0], false), None);
    }
}
