//! Residuals of laid frames against the log.

use nalgebra::{Point2, Point3, SVector};
use serde::{Deserialize, Serialize};

use crate::navigator::Run;
use pilotage_base::frames::{Attitude, GroundPoint, Pose, wrap_pi};
use pilotage_flight::{ChannelName, Flight};

/// Unknowns: time offset (s), drift of the clock, mount's roll, pitch and yaw (rad), natural logarithm of the
/// focal length's factor, satellite navigation's bias north and east (m).
pub const UNKNOWNS: usize = 8;
/// Numbers a frame says: place north and east (m), yaw (rad), logarithm of the height.
pub const SAID: usize = 4;

/// A vector of the unknowns.
pub type Unknowns = SVector<f64, UNKNOWNS>;

/// A frame that was laid on the map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RegisteredPose {
    /// Index in the flight.
    pub index: usize,
    /// Seconds by the camera's clock.
    pub time: f64,
    /// Place of the map in the middle of the picture.
    pub centre: GroundPoint,
    /// Heading of the body that the picture shows, radians.
    pub yaw: f64,
    /// Height above the ground that the picture shows through the lens as it is believed to be, metres.
    pub height: f64,
    /// Turn of the stored picture that was noticed, radians.
    pub stored_turn: f64,
}

/// The frames of a run that were laid on the map and corrected the estimate.
pub fn laid_frames(flight: &Flight, run: &Run) -> Vec<RegisteredPose> {
    let frames = run.steps.iter().filter_map(|step| {
        let frame = step.frame.as_ref()?;
        let laid = frame.laid.as_ref().filter(|laid| laid.is_believed())?;
        let place = laid.place.as_ref()?;
        Some(RegisteredPose {
            index: frame.index,
            time: flight.frames.get(frame.index)?.time,
            centre: place.centre,
            yaw: place.pose.attitude.yaw,
            height: flight.ground_down - place.pose.position_in_world.z,
            stored_turn: place.stored_turn,
        })
    });
    frames.collect()
}

/// Log against which the frames are held.
pub struct ReferenceLog<'a> {
    pub flight: &'a Flight,
    /// Time about which the clock's drift counts, seconds.
    pub middle: f64,
    /// Whether there is an attitude.
    pub has_heading: bool,
    /// Whether there is a height.
    pub has_height: bool,
    /// First and last fix of satellite navigation, seconds.
    pub span: (f64, f64),
}

impl<'a> ReferenceLog<'a> {
    /// `None` without satellite navigation.
    pub fn new(flight: &'a Flight, frames: &[RegisteredPose]) -> Option<Self> {
        let filled = |name| flight.channel(name).filter(|c| !c.times.is_empty());
        let gps = filled(ChannelName::GpsNorth)?;
        filled(ChannelName::GpsEast)?;
        let times = frames.iter().map(|frame| frame.time);
        Some(Self {
            flight,
            middle: times.sum::<f64>() / frames.len().max(1) as f64,
            has_heading: filled(ChannelName::Heading).is_some(),
            has_height: filled(ChannelName::HeightAboveGround).is_some(),
            span: (*gps.times.first()?, *gps.times.last()?),
        })
    }

    /// Time by the log of a time by the camera.
    pub fn time(&self, camera_time: f64, unknowns: &Unknowns) -> f64 {
        camera_time + unknowns[0] + unknowns[1] * (camera_time - self.middle)
    }

    /// Residual of `frame` against what the log lets expect; numbers that cannot be told are missing.
    pub fn residual(
        &self,
        frame: &RegisteredPose,
        unknowns: &Unknowns,
    ) -> Option<[Option<f64>; SAID]> {
        let flight = self.flight;
        let time = self.time(frame.time, unknowns);
        if !(self.span.0..=self.span.1).contains(&time) {
            return None;
        }
        let value = |name| flight.value(name, time);
        let mut camera = flight.camera.clone();
        camera.mount.roll += unknowns[2];
        camera.mount.pitch += unknowns[3];
        camera.mount.yaw += unknowns[4];
        camera.focal *= unknowns[5].exp();
        let stored = flight.frames.get(frame.index)?.stored_turn;
        let camera = camera.stored_turned(stored + frame.stored_turn);
        // A longer lens shows the same ground from higher up.
        let seen_height = frame.height * unknowns[5].exp();
        let measured = value(ChannelName::HeightAboveGround).filter(|h| *h > 0.0);
        let height = measured.unwrap_or(seen_height);
        let attitude = flight.attitude(time);
        let pose = Pose {
            position_in_world: Point3::new(
                value(ChannelName::GpsNorth)? + unknowns[6],
                value(ChannelName::GpsEast)? + unknowns[7],
                flight.ground_down - height,
            ),
            attitude: attitude.unwrap_or(Attitude {
                yaw: frame.yaw,
                ..Attitude::default()
            }),
        };
        let middle = Point2::new(0.5 * camera.width as f64, 0.5 * camera.height as f64);
        let expected = camera.ground_at(&pose, &middle, flight.ground_down)?;
        Some([
            Some(frame.centre.north - expected.north),
            Some(frame.centre.east - expected.east),
            // What the picture shows of the heading has the mount in it.
            attitude.map(|attitude| wrap_pi(frame.yaw - attitude.yaw - unknowns[4])),
            measured.map(|measured| (seen_height / measured).ln()),
        ])
    }
}
