//! Pictures of a video as the frames of a flight.

use serde::{Deserialize, Serialize};

use pilotage_flight::{Flight, Frame};
use pilotage_raster::camera::CameraModel;

/// Relation between the clock of a video and that of a flight: flight time = `offset` + `rate` · video time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct VideoClock {
    /// When the video begins, seconds in the flight's time base.
    pub offset: f64,
    /// Seconds of the flight in a second of the video.
    pub rate: f64,
}

impl Default for VideoClock {
    fn default() -> Self {
        Self {
            offset: 0.0,
            rate: 1.0,
        }
    }
}

impl VideoClock {
    /// A time of the video in the flight's time base, seconds.
    ///
    /// ```
    /// use pilotage_readers::video::VideoClock;
    ///
    /// // Recording began 12 s into the flight; every second is played in two.
    /// let clock = VideoClock { offset: 12.0, rate: 0.5 };
    /// assert_eq!(clock.flight_time(10.0), 17.0);
    /// ```
    pub fn flight_time(&self, video_time: f64) -> f64 {
        self.offset + self.rate * video_time
    }
}

/// The flight with the pictures of a video as its frames, taken by `camera`: one at each of `times`, seconds of the
/// video, in its order. Pictures are called `name` and their number, counted from one.
///
/// Whoever gives the pictures themselves has to give those of the same order.
pub fn with_pictures(
    flight: Flight,
    name: &str,
    times: &[f64],
    clock: VideoClock,
    camera: CameraModel,
) -> Flight {
    let frames = times.iter().enumerate().map(|(index, time)| Frame {
        time: clock.flight_time(*time),
        name: format!("{name} {}", index + 1),
        stored_turn: 0.0,
    });
    Flight {
        camera,
        frames: frames.collect(),
        ..flight
    }
}
