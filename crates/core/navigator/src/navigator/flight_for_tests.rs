//! A flight of which only the readings matter, for tests.

use pilotage_base::frames::GroundPoint;
use pilotage_flight::{Channel, Flight, StartFix};
use pilotage_raster::camera::CameraModel;

/// The flight with these readings, without pictures, from the origin on, known to a metre.
pub fn flight_of(channels: Vec<Channel>) -> Flight {
    Flight {
        name: "test".to_owned(),
        frame_on_globe: None,
        camera: CameraModel::pinhole(64, 48, 1.0),
        ground_down: 0.0,
        channels,
        frames: Vec::new(),
        start: StartFix {
            time: 0.0,
            position: GroundPoint::default(),
            standard_deviation: 1.0,
        },
        truth: None,
    }
}
