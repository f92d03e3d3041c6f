//! Priors of frames, and a frame that shows nothing, for tests.

use super::look::FrameLook;
use super::prior::{HeadingPrior, PosePrior, StoredTurn};
use super::shape::MapShape;
use pilotage_base::frames::GroundPoint;
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::Blank;
use pilotage_raster::raster::{Gray, Pyramid};

/// Prior of a level camera 100 m above the origin to 10 m per axis, its height and heading as good as they are mostly told.
pub fn usual_prior() -> PosePrior {
    PosePrior {
        position: GroundPoint::new(0.0, 0.0),
        position_deviation: 10.0,
        anywhere_on: None,
        height: 100.0,
        log_height_deviation: 0.05,
        heading: around(0.0, 0.05),
        roll: 0.0,
        pitch: 0.0,
        tilt_deviation: 0.05,
        slope_deviation: 0.05,
        shape: MapShape::default(),
        shape_deviation: 0.02,
        map_deviation: 0.0,
    }
}

/// A heading that is told, with its standard deviation, radians.
pub fn around(heading: f64, deviation: f64) -> HeadingPrior {
    HeadingPrior::Around {
        heading,
        deviation,
        stored: StoredTurn::None,
    }
}

/// A frame of one grey over a map of nothing.
pub struct GreyFrame {
    camera: CameraModel,
    luminance: Pyramid,
}

impl GreyFrame {
    /// Of a camera.
    pub fn new(camera: CameraModel) -> Self {
        let luminance = Pyramid::new(Gray::filled(4, 4, 0.5), 1);
        Self { camera, luminance }
    }

    /// The frame over flat ground.
    pub fn look(&self) -> FrameLook<'_> {
        FrameLook {
            camera: &self.camera,
            ground_down: 0.0,
            luminance: &self.luminance,
            map: &Blank,
        }
    }
}
