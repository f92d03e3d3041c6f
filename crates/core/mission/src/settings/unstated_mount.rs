//! A camera whose mount nobody states, in the settings of a navigator.

use pilotage_flight::{ChannelName, Flight, Frame};

use super::{NavigatorSettings, SensorNoise};

/// Largest root mean square of roll and pitch of craft that carry their camera in a gimbal, radians: what banks more is an
/// airplane, with which its camera turns.
const MOST_SWUNG: f64 = 0.09;

impl NavigatorSettings {
    /// The settings for the camera of a flight: where nobody states its mount, it is tilted by an angle that stays, and that
    /// by which the aircraft reads to be tilted may be that of a gimbal. Settings that allow for as much stay as they are.
    ///
    /// ```
    /// use pilotage_flight::{Flight, StartFix};
    /// use pilotage_base::frames::GroundPoint;
    /// use pilotage_mission::settings::NavigatorSettings;
    /// use pilotage_raster::camera::CameraModel;
    ///
    /// let mut flight = Flight {
    ///     name: "photos".to_owned(),
    ///     frame_on_globe: None,
    ///     camera: CameraModel::pinhole(320, 240, 1.0),
    ///     ground_down: 0.0,
    ///     channels: Vec::new(),
    ///     frames: Vec::new(),
    ///     start: StartFix { time: 0.0, position: GroundPoint::default(), standard_deviation: 1.0 },
    ///     truth: None,
    /// };
    /// let usual = NavigatorSettings::default();
    /// assert_eq!(usual.clone().for_camera_of(&flight), usual);
    /// flight.camera.mount_deviation = 0.17;
    /// let widened = usual.for_camera_of(&flight);
    /// assert_eq!(widened.sensors.tilt_bias, 0.17);
    /// assert_eq!(widened.clone().for_camera_of(&flight), widened);
    /// ```
    #[must_use]
    pub fn for_camera_of(mut self, flight: &Flight) -> Self {
        let mount = flight.camera.mount_deviation;
        if mount <= self.sensors.tilt_bias {
            return self;
        }
        self.sensors = SensorNoise {
            roll: self.sensors.roll.hypot(mount),
            pitch: self.sensors.pitch.hypot(mount),
            tilt_bias: self.sensors.tilt_bias.hypot(mount),
            ..self.sensors
        };
        if let Some(frames) = &mut self.whole_frames {
            let unknown = swung(flight).min(MOST_SWUNG);
            frames.tilt_deviation = frames.tilt_deviation.hypot(unknown);
        }
        self
    }
}

/// Root mean square of roll and pitch as they read when the pictures were taken, radians: by that a camera is tilted
/// otherwise than the aircraft if it hangs in a gimbal, of which nothing is known where nobody states the mount.
fn swung(flight: &Flight) -> f64 {
    let mean_square = |name| {
        let read = |frame: &Frame| flight.value(name, frame.time);
        let readings: Vec<f64> = flight.frames.iter().filter_map(read).collect();
        let squares: f64 = readings.iter().map(|angle| angle * angle).sum();
        squares / readings.len().max(1) as f64
    };
    let both = mean_square(ChannelName::Roll) + mean_square(ChannelName::Pitch);
    (0.5 * both).sqrt()
}
