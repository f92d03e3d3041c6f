//! Under which circumstances a landmark shall be found.

use serde::{Deserialize, Serialize};

use pilotage_mission::settings::SensorNoise;
use pilotage_raster::camera::CameraModel;
use pilotage_vision::landmark::trained::Variants;

/// Standard deviations of an error that a search must hold.
const HELD: f64 = 2.5;
/// Error of the heading that does no harm, on either side, radians: the ±5° of the thesis.
const HEADING: f64 = 5.0 * std::f64::consts::PI / 180.0;

/// Range of the flights on which a landmark shall be found: pictures are drawn from all over it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FlightEnvelope {
    /// The camera of the flights.
    pub camera: CameraModel,
    /// Least and greatest height of the camera above ground, metres.
    pub height: [f64; 2],
    /// Greatest tilt of the camera, in any direction, of which the filter knows: a bank angle, radians.
    pub tilt: f64,
    /// Greatest error of the heading on either side, radians.
    pub heading_error: f64,
    /// Errors of the camera's pose of which the filter does not know, vibration of the mount included.
    pub sensors: SensorNoise,
    /// Standard deviation of the filter's position per axis, metres.
    pub position: f64,
    /// Least and greatest blur of the optics and of motion, standard deviation in pixels.
    pub blur: [f64; 2],
    /// Least and greatest noise of the sensor, grey levels of 255.
    pub noise: [f64; 2],
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
}

impl FlightEnvelope {
    /// Around flights at `height` metres above ground with that camera and those sensors.
    ///
    /// ```
    /// use pilotage_mission::settings::NavigatorSettings;
    /// use pilotage_raster::camera::CameraModel;
    /// use pilotage_training::FlightEnvelope;
    ///
    /// let camera = CameraModel::pinhole(640, 480, 1.0);
    /// let sensors = NavigatorSettings::default().sensors;
    /// let envelope = FlightEnvelope::around(&camera, 100.0, sensors);
    /// assert_eq!(envelope.height, [85.0, 120.0]);
    /// // The heading may be wrong by the 5° of the thesis at least.
    /// assert!((envelope.heading_error - 5_f64.to_radians()).abs() < 1e-9);
    /// ```
    pub fn around(camera: &CameraModel, height: f64, sensors: SensorNoise) -> Self {
        Self {
            camera: camera.clone(),
            height: [0.85 * height, 1.2 * height],
            tilt: 15_f64.to_radians(),
            heading_error: HEADING.max(HELD * sensors.yaw),
            sensors,
            position: 5.0,
            blur: [0.3, 1.0],
            noise: [1.0, 4.0],
            ground_down: 0.0,
        }
    }
    /// The turns and sizes that the ground may have next to what the filter thinks.
    pub fn variants(&self) -> Variants {
        let height = 0.5 * (self.height[0] + self.height[1]);
        let log_scale = (HELD * self.sensors.height / height).ln_1p();
        Variants::covering(self.heading_error, log_scale)
    }
}
