//! Camera of a photo that was taken looking down.

use pilotage_core::camera::CameraModel;
use pilotage_core::frames::Attitude;
use pilotage_core::raster::Picture;

/// Tilt of a camera that looks down, on the command line.
#[derive(clap::Args)]
pub struct LookingDown {
    /// Angle by which the camera looks ahead of straight down, degrees.
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = 0.0,
        allow_hyphen_values = true
    )]
    ahead: f64,
}

impl LookingDown {
    /// Attitude of the camera where the picture's top is on a heading, radians from north.
    pub fn attitude(&self, heading: f64) -> Attitude {
        Attitude {
            pitch: self.ahead.to_radians(),
            ..Attitude::level(heading)
        }
    }
}

/// Camera of a focal length in pixels that took a picture.
pub fn camera_of(picture: &Picture, focal: f64) -> CameraModel {
    let across = 2.0 * (0.5 * picture.width() as f64 / focal).atan();
    CameraModel::pinhole(picture.width(), picture.height(), across)
}
