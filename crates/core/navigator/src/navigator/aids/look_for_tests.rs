//! Looks for tests: what an engine believes of a camera, as a rule level and facing north, without anything in its picture.

use nalgebra::{DMatrix, Matrix3, Vector3, dvector};

use super::super::engine::{Engine, MeasurementModel, engine, map_error};
use super::super::expected::AppearanceModel;
use super::super::observation::GaussianState;
use super::aid::AidLook;
use pilotage_base::frames::{Attitude, GroundPoint};
use pilotage_mission::settings::{NavigatorSettings, SensorNoise};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::raster::Picture;

/// Usual height of the camera above the ground, metres.
pub const HEIGHT: f64 = 300.0;

/// Camera, how it is held, picture and settings of looks.
pub struct TestLooks {
    pub settings: NavigatorSettings,
    pub camera: CameraModel,
    pub attitude: Attitude,
    /// Above the ground, metres.
    pub height: f64,
    pub picture: Picture,
}

impl Default for TestLooks {
    fn default() -> Self {
        Self {
            settings: NavigatorSettings::default(),
            camera: CameraModel::pinhole(64, 48, 2.0),
            attitude: Attitude::level(0.0),
            height: HEIGHT,
            picture: Picture::from_fn(64, 48, |_, _| [90; 3]),
        }
    }
}

impl TestLooks {
    /// An engine that believes the aircraft at the origin to `deviation` metres per axis.
    pub fn engine(&self, deviation: f64) -> Box<dyn Engine> {
        engine(&self.settings, GroundPoint::default(), deviation).expect("sound settings")
    }

    /// Look by what `engine` believes, of an attitude to 0.1 mrad and a height to a millimetre.
    pub fn look(&self, engine: &dyn Engine) -> AidLook<'_> {
        let of_place = MeasurementModel::of_pose(|seen| {
            let bias = seen.heading_bias.unwrap_or(0.0);
            Some(dvector![seen.on_map.north, seen.on_map.east, bias])
        });
        let belief = engine
            .expect(&of_place, &(1e-12 * DMatrix::identity(3, 3)))
            .expect("a belief");
        let model = AppearanceModel {
            camera: &self.camera,
            attitude: self.attitude,
            camera_down: -self.height,
            ground_down: 0.0,
        };
        let mean = Vector3::from_column_slice(belief.mean.as_slice());
        AidLook {
            picture: &self.picture,
            pose: model.pose(GroundPoint::new(mean.x, mean.y), mean.z),
            model,
            belief: GaussianState {
                mean,
                covariance: Matrix3::from_column_slice(belief.covariance.as_slice()),
            },
            noise: SensorNoise {
                roll: 1e-4,
                pitch: 1e-4,
                yaw: 1e-4,
                height: 1e-3,
                pixel: 0.0,
                ground: 0.0,
                tilt_bias: 0.0,
                yaw_bias: 0.0,
                height_bias: 0.0,
            },
            map_deviation: map_error(&self.settings).map_or(0.0, |error| error.deviation),
        }
    }
}
