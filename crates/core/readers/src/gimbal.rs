//! Angles of a camera's gimbal, which counts from the horizon, as those of a camera that looks down at zero.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Rotation3;
use pilotage_base::frames::{Attitude, wrap_pi};

/// Angle to a level view within which heading and roll of a camera that looks down cannot be told apart, radians.
const NEAR_LEVEL: f64 = 5.0 * PI / 180.0;

/// The attitude of a gimbal, whose pitch of -π/2 looks straight down, as one of a camera that looks down at zero with the
/// picture's top ahead; angles in radians.
///
/// A gimbal rolls about the view: Rz(yaw) Ry(pitch) Rx(roll). The camera that looks down is turned by a quarter about its
/// right side, Rz(yaw) Ry(pitch + π/2) Rz(roll), so that straight down a roll turns the picture about the vertical. Of the
/// two sets of angles of this rotation the one that rolls by less than a quarter is taken; within 5° of a level view a
/// roll as small is left out: heading and roll could not be told apart.
pub fn looking_down(gimbal: Attitude) -> Attitude {
    let pitch = wrap_pi(gimbal.pitch + FRAC_PI_2);
    let is_level = pitch.cos().abs() < NEAR_LEVEL.sin();
    let is_small = wrap_pi(gimbal.roll).abs() < NEAR_LEVEL;
    if gimbal.roll == 0.0 || is_level && is_small {
        return Attitude {
            roll: 0.0,
            pitch,
            yaw: gimbal.yaw,
        };
    }
    let down = Rotation3::from_euler_angles(0.0, FRAC_PI_2, 0.0);
    let (roll, pitch, yaw) = (gimbal.world_from_body() * down).euler_angles();
    if roll.abs() <= FRAC_PI_2 {
        Attitude { roll, pitch, yaw }
    } else {
        Attitude {
            roll: wrap_pi(roll + PI),
            pitch: wrap_pi(PI - pitch),
            yaw: wrap_pi(yaw + PI),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn degrees(roll: f64, pitch: f64, yaw: f64) -> Attitude {
        let [roll, pitch, yaw] = [roll, pitch, yaw].map(f64::to_radians);
        Attitude { roll, pitch, yaw }
    }

    #[test]
    fn a_gimbal_rolls_about_the_view() {
        // Rz(yaw) Ry(pitch + 90°) Rz(roll): straight down roll and yaw add.
        for (gimbal, expected) in [
            ((0.0, -90.0, 30.0), (0.0, 0.0, 30.0)),
            ((180.0, -90.0, -170.0), (0.0, 0.0, 10.0)),
            ((90.0, -90.0, 0.0), (0.0, 0.0, 90.0)),
            ((0.0, -60.0, 30.0), (0.0, 30.0, 30.0)),
            // The picture is upside down: its top looks back.
            ((180.0, -60.0, 0.0), (0.0, -30.0, 180.0)),
            // A level view keeps its direction.
            ((0.5, 0.0, 30.0), (0.0, 90.0, 30.0)),
            ((0.0, 10.0, 30.0), (0.0, 100.0, 30.0)),
        ] {
            let found = looking_down(degrees(gimbal.0, gimbal.1, gimbal.2));
            let expected = degrees(expected.0, expected.1, expected.2);
            for (found, expected) in [
                (found.roll, expected.roll),
                (found.pitch, expected.pitch),
                (found.yaw, expected.yaw),
            ] {
                assert!(
                    wrap_pi(found - expected).abs() < 1e-9,
                    "{gimbal:?}: {found}"
                );
            }
        }
    }

    #[test]
    fn the_rotation_is_that_of_the_gimbal_turned_by_a_quarter() {
        let down = Rotation3::from_euler_angles(0.0, FRAC_PI_2, 0.0);
        for roll in [-170.0, -60.0, -5.0, 3.0, 45.0, 120.0] {
            for pitch in [-150.0, -90.0, -45.0, -20.0, 30.0] {
                let gimbal = degrees(roll, pitch, 70.0);
                let found = looking_down(gimbal);
                let off = found.world_from_body().inverse() * gimbal.world_from_body() * down;
                assert!(off.angle() < 1e-6, "{roll} {pitch}");
                assert!(found.roll.abs() <= FRAC_PI_2 + 1e-9);
            }
        }
    }
}
