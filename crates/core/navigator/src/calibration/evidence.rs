//! The frames of a run beside the log, and how far they are from it for any camera.

use nalgebra::Point2;
use serde::{Deserialize, Serialize};

use super::residual::{ReferenceLog, RegisteredPose, Unknowns, laid_frames};
use crate::navigator::Run;
use pilotage_base::frames::{GroundPoint, Pose};
use pilotage_flight::{ChannelName, Flight};
use pilotage_mission::settings::CameraAdjustment;

/// Channels that are read of the log.
const READ: [ChannelName; 6] = [
    ChannelName::GpsNorth,
    ChannelName::GpsEast,
    ChannelName::Heading,
    ChannelName::Roll,
    ChannelName::Pitch,
    ChannelName::HeightAboveGround,
];
/// Half the time over which the direction of flight is taken, seconds.
const TRACK_REACH: f64 = 1.0;
/// Distance flown in that time below which there is no direction of flight, metres.
const LEAST_TRACK: f64 = 1.0;

/// The frames that a run laid on the map and what its flight measured around them: all that is needed to judge
/// a camera, and no more.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraEvidence {
    flight: Flight,
    frames: Vec<RegisteredPose>,
}

/// Residual of a laid frame: its deviation from what the log lets expect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameResidual {
    /// Index of the frame.
    pub frame: usize,
    /// Time of the frame as the flight has it, seconds.
    pub time: f64,
    /// Place in the middle of the picture, north of the expected one, metres.
    pub north: f64,
    /// The same to the east, metres.
    pub east: f64,
    /// The same forward along the track over ground and to the right of it, metres; missing where it hovers.
    pub along_and_across: Option<(f64, f64)>,
    /// Heading, radians; missing without a logged heading.
    pub heading: Option<f64>,
    /// Natural logarithm of the height's ratio; missing without a logged height.
    pub log_height: Option<f64>,
}

/// Root mean squares over frames.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ResidualSummary {
    /// Frames that fall into the log.
    pub frames: usize,
    /// Distance from the expected place, metres.
    pub place: f64,
    /// Median of that distance, metres.
    pub median_place: f64,
    /// Heading, radians, if any frame says it.
    pub heading: Option<f64>,
    /// Natural logarithm of the height's ratio, if any frame says it.
    pub log_height: Option<f64>,
}

impl CameraEvidence {
    /// Evidence that `run` found in the pictures of `flight`, which has to be the flight as the run knew it.
    pub fn of(flight: &Flight, run: &Run) -> Self {
        Self::from_frames(flight, laid_frames(flight, run))
    }

    pub(super) fn from_frames(flight: &Flight, frames: Vec<RegisteredPose>) -> Self {
        let read = flight.channels.iter().filter(|c| READ.contains(&c.name));
        Self {
            flight: Flight {
                name: flight.name.clone(),
                frame_on_globe: None,
                camera: flight.camera.clone(),
                ground_down: flight.ground_down,
                channels: read.cloned().collect(),
                frames: flight.frames.clone(),
                start: flight.start,
                truth: None,
            },
            frames,
        }
    }

    /// Frames that were laid on the map.
    pub fn frames(&self) -> usize {
        self.frames.len()
    }

    /// The mean of their times as the flight has them, seconds; zero without any.
    pub fn middle(&self) -> f64 {
        let times = self.frames.iter().map(|frame| frame.time);
        times.sum::<f64>() / self.frames.len().max(1) as f64
    }

    /// Residuals of the laid frames against the log, were the camera changed by `change` and satellite
    /// navigation off the map by `bias` (north, east; metres). Frames that fall outside the log are left out;
    /// nothing without satellite navigation.
    pub fn residuals(&self, change: &CameraAdjustment, bias: [f64; 2]) -> Vec<FrameResidual> {
        let Some(log) = ReferenceLog::new(&self.flight, &self.frames) else {
            return Vec::new();
        };
        let change = change.about(log.middle);
        let unknowns = Unknowns::from([
            change.offset,
            change.drift,
            change.roll,
            change.pitch,
            change.yaw,
            change.log_focal,
            bias[0],
            bias[1],
        ]);
        let of = |frame: &RegisteredPose| {
            let [north, east, heading, log_height] = log.residual(frame, &unknowns)?;
            let (north, east) = (north?, east?);
            let track = self.track(log.time(frame.time, &unknowns));
            Some(FrameResidual {
                frame: frame.index,
                time: frame.time,
                north,
                east,
                along_and_across: track.map(|track| {
                    let (sin, cos) = track.sin_cos();
                    (north * cos + east * sin, east * cos - north * sin)
                }),
                heading,
                log_height,
            })
        };
        self.frames.iter().filter_map(of).collect()
    }

    /// Direction of flight over ground at a time by the log, radians from north over east; `None` where it hovers.
    fn track(&self, time: f64) -> Option<f64> {
        let value = |name, time| self.flight.value(name, time);
        let moved =
            |name| Some(value(name, time + TRACK_REACH)? - value(name, time - TRACK_REACH)?);
        let (north, east): (f64, f64) =
            (moved(ChannelName::GpsNorth)?, moved(ChannelName::GpsEast)?);
        (north.hypot(east) > LEAST_TRACK).then(|| east.atan2(north))
    }

    /// The ground that frame `index` would show by the log alone, were the camera changed by `change`; corners in
    /// their order around it. `None` where the log does not say where the aircraft was.
    pub fn footprint(&self, index: usize, change: &CameraAdjustment) -> Option<Vec<GroundPoint>> {
        let frame = self.flight.frames.get(index)?;
        let time = change.time(frame.time);
        let value = |name| self.flight.value(name, time);
        let laid = self.frames.iter().find(|laid| laid.index == index);
        let height = value(ChannelName::HeightAboveGround).filter(|h| *h > 0.0);
        let height = height.or(laid.map(|laid| laid.height * change.log_focal.exp()))?;
        let pose = Pose {
            position_in_world: nalgebra::Point3::new(
                value(ChannelName::GpsNorth)?,
                value(ChannelName::GpsEast)?,
                self.flight.ground_down - height,
            ),
            attitude: self.flight.attitude(time)?,
        };
        let mut camera = self.flight.camera.clone();
        change.change(&mut camera);
        let turn = frame.stored_turn + laid.map_or(0.0, |laid| laid.stored_turn);
        let camera = camera.stored_turned(turn);
        let corner = |pixel: &Point2<f64>| camera.ground_at(&pose, pixel, self.flight.ground_down);
        camera.corners().iter().map(corner).collect()
    }

    pub(super) fn log(&self) -> Option<ReferenceLog<'_>> {
        ReferenceLog::new(&self.flight, &self.frames)
    }

    pub(super) fn laid(&self) -> &[RegisteredPose] {
        &self.frames
    }
}

impl ResidualSummary {
    /// Of these frames.
    pub fn of(residuals: &[FrameResidual]) -> Self {
        let mean_square = |values: &mut dyn Iterator<Item = f64>| {
            let (mut sum, mut count) = (0.0, 0_usize);
            for value in values {
                sum += value * value;
                count += 1;
            }
            (count > 0).then(|| (sum / count as f64).sqrt())
        };
        let mut places: Vec<f64> = (residuals.iter().map(|r| r.north.hypot(r.east))).collect();
        let place = mean_square(&mut places.iter().copied());
        places.sort_by(f64::total_cmp);
        Self {
            frames: residuals.len(),
            place: place.unwrap_or(f64::NAN),
            median_place: places.get(places.len() / 2).copied().unwrap_or(f64::NAN),
            heading: mean_square(&mut residuals.iter().filter_map(|r| r.heading)),
            log_height: mean_square(&mut residuals.iter().filter_map(|r| r.log_height)),
        }
    }
}
