//! True states of a flight, where they are known.

use nalgebra::{Point3, Vector2};
use serde::{Deserialize, Serialize};

use pilotage_base::frames::{Attitude, Pose};

/// True state of the vehicle at one time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TruthState {
    /// Seconds in the flight's time base.
    pub time: f64,
    /// Position in world NED, metres.
    pub position: Point3<f64>,
    /// Attitude of the body, where known.
    pub attitude: Option<Attitude>,
    /// Mean wind: velocity of the air (north, east), m/s, where known. Gusts are not part of it.
    pub wind: Option<Vector2<f64>>,
}

/// True pose of the camera's carrier when a frame was taken.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrameTruth {
    /// Position in world NED, metres.
    pub position: Point3<f64>,
    /// Attitude that carried the camera, vibration of the mount included, where known.
    pub camera_attitude: Option<Attitude>,
}

impl FrameTruth {
    /// The pose from which the frame was really taken, where the attitude is known.
    ///
    /// ```
    /// use nalgebra::Point3;
    /// use pilotage_base::frames::Attitude;
    /// use pilotage_flight::FrameTruth;
    ///
    /// let position = Point3::new(10.0, 0.0, -120.0);
    /// let seen = FrameTruth { position, camera_attitude: Some(Attitude::level(0.5)) };
    /// assert_eq!(seen.pose().map(|pose| pose.attitude.yaw), Some(0.5));
    /// // Without an attitude nobody knows what was in view.
    /// assert!(FrameTruth { position, camera_attitude: None }.pose().is_none());
    /// ```
    pub fn pose(&self) -> Option<Pose> {
        self.camera_attitude.map(|attitude| Pose {
            position_in_world: self.position,
            attitude,
        })
    }
}

/// The truth of a flight.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Truth {
    /// In time order.
    pub states: Vec<TruthState>,
    /// Truth of each frame of the flight, in their order, or empty.
    pub frames: Vec<FrameTruth>,
}

impl Truth {
    /// Position at `time` by linear interpolation, `None` outside the known span.
    ///
    /// ```
    /// use nalgebra::{Point3, Vector2};
    /// use pilotage_flight::{Truth, TruthState};
    ///
    /// let at = |time: f64, north: f64| TruthState {
    ///     time,
    ///     position: Point3::new(north, 0.0, -100.0),
    ///     attitude: None,
    ///     wind: Some(Vector2::new(3.0, 4.0)),
    /// };
    /// let truth = Truth { states: vec![at(0.0, 0.0), at(1.0, 20.0)], frames: Vec::new() };
    /// assert_eq!(truth.position(0.25), Some(Point3::new(5.0, 0.0, -100.0)));
    /// assert_eq!(truth.position(1.5), None);
    /// ```
    pub fn position(&self, time: f64) -> Option<Point3<f64>> {
        let after = self.states.partition_point(|s| s.time <= time + 1e-9);
        let earlier = self.states.get(after.checked_sub(1)?)?;
        let Some(later) = self.states.get(after) else {
            return (time - earlier.time < 1e-6).then_some(earlier.position);
        };
        let fraction = (time - earlier.time) / (later.time - earlier.time);
        Some(earlier.position + fraction * (later.position - earlier.position))
    }

    /// Mean wind (north, east) at `time`, m/s, where known.
    pub fn wind(&self, time: f64) -> Option<Vector2<f64>> {
        let after = self.states.partition_point(|s| s.time <= time + 1e-9);
        self.states.get(after.checked_sub(1)?)?.wind
    }
}
