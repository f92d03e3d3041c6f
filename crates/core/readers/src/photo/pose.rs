//! Pose of the camera as a single photo tells it: height and attitude.

use std::f64::consts::FRAC_PI_2;

use super::place::PhotoPlaceSource;
use super::read::Photo;
use crate::gimbal::looking_down;
use pilotage_base::frames::{Attitude, wrap_pi};

/// Attitude and height of a camera that looks down; zero roll and pitch look straight down with the picture's top
/// ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhotoPose {
    /// Heading, radians clockwise from north, where anything tells it.
    pub heading: Option<f64>,
    /// Roll, radians.
    pub roll: f64,
    /// Pitch, radians; positive looks ahead.
    pub pitch: f64,
    /// Height above take-off, metres: above the ground only where that is level.
    pub height: Option<f64>,
    /// Who told the attitude, for people.
    pub told_by: &'static str,
}

/// The attitude of the camera by its gimbal, zero looking straight down; `None` where the photo does not tell it.
pub(super) fn by_gimbal(photo: &Photo) -> Option<Attitude> {
    let gimbal = photo.gimbal?;
    Some(if photo.is_roll_about_top {
        Attitude {
            pitch: wrap_pi(gimbal.pitch + FRAC_PI_2),
            ..gimbal
        }
    } else {
        looking_down(gimbal)
    })
}

/// Pose that a photo tells: by the gimbal, else by the aircraft's heading with the camera straight down, else
/// by the direction in EXIF or in a table beside it.
pub fn photo_pose(photo: &Photo) -> PhotoPose {
    let pose = |heading, roll, pitch, told_by| PhotoPose {
        heading,
        roll,
        pitch,
        height: photo.height_above_take_off,
        told_by,
    };
    match (by_gimbal(photo), photo.aircraft) {
        (Some(camera), _) => pose(
            Some(wrap_pi(camera.yaw)),
            wrap_pi(camera.roll),
            camera.pitch,
            "by the gimbal",
        ),
        (None, Some(aircraft)) if photo.is_gimbal_blank => pose(
            Some(wrap_pi(aircraft.yaw)),
            0.0,
            0.0,
            "by the aircraft, since the gimbal's angles are all zero; the camera is taken to look straight down",
        ),
        (None, Some(aircraft)) => pose(
            Some(wrap_pi(aircraft.yaw)),
            aircraft.roll,
            aircraft.pitch,
            "by the aircraft, to which the camera counts as fixed",
        ),
        (None, None) => {
            let told_by = match (photo.direction, photo.placed_by) {
                (Some(_), PhotoPlaceSource::Photo) => "by the direction in EXIF",
                (Some(_), PhotoPlaceSource::Table) => {
                    "by the direction in EXIF or the table beside it"
                }
                (None, _) => "by nothing",
            };
            pose(photo.direction.map(wrap_pi), 0.0, 0.0, told_by)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn attitude(roll: f64, pitch: f64, yaw: f64) -> Attitude {
        Attitude { roll, pitch, yaw }
    }

    #[test]
    fn the_gimbal_comes_before_the_aircraft_unless_it_is_blank() {
        let both = Photo {
            gimbal: Some(attitude(0.0, -FRAC_PI_2, 1.0)),
            aircraft: Some(attitude(0.1, 0.2, 2.0)),
            ..Photo::default()
        };
        let told = photo_pose(&both);
        assert_eq!((told.heading, told.roll, told.pitch), (Some(1.0), 0.0, 0.0));
        let blank = Photo {
            gimbal: None,
            is_gimbal_blank: true,
            ..both.clone()
        };
        let told = photo_pose(&blank);
        assert_eq!((told.heading, told.roll, told.pitch), (Some(2.0), 0.0, 0.0));
        let fixed = Photo {
            gimbal: None,
            ..both
        };
        let told = photo_pose(&fixed);
        assert_eq!((told.heading, told.roll, told.pitch), (Some(2.0), 0.1, 0.2));
    }

    #[test]
    fn a_gimbal_that_turned_over_looks_down_with_the_opposite_heading() {
        let degrees = [180.0_f64, -90.0, -170.0].map(f64::to_radians);
        let flipped = Photo {
            gimbal: Some(attitude(degrees[0], degrees[1], degrees[2])),
            ..Photo::default()
        };
        let told = photo_pose(&flipped);
        let heading = told.heading.expect("the gimbal tells it");
        assert!((heading.to_degrees() - 10.0).abs() < 1e-9, "{heading}");
        assert!(told.roll.abs() < 1e-9 && told.pitch.abs() < 1e-9);
        // Where the roll is about the picture's top, it stays one.
        let of_top = Photo {
            gimbal: Some(attitude(0.1, 0.2 - FRAC_PI_2, 1.0)),
            is_roll_about_top: true,
            ..Photo::default()
        };
        let told = photo_pose(&of_top);
        assert!(told.heading == Some(1.0) && (told.roll - 0.1).abs() < 1e-12);
        assert!((told.pitch - 0.2).abs() < 1e-12);
    }
}
