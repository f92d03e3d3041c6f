//! A flight: one type whether it came from a log, a folder or the simulator.

use serde::{Deserialize, Serialize};

use super::{Channel, ChannelName, Frame, Truth};
use pilotage_base::frames::{Attitude, GroundPoint, LocalFrame};
use pilotage_raster::camera::CameraModel;

/// Frame by whose place flights of one name are told apart: late enough for wind and gusts to have moved them.
const EARLY_FRAME: usize = 10;

/// The position with which navigation begins.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StartFix {
    /// Seconds in the flight's time base.
    pub time: f64,
    /// Position in the world frame.
    pub position: GroundPoint,
    /// Standard deviation per axis, metres.
    pub standard_deviation: f64,
}

/// Measurements of a flight; read-only for everybody above.
///
/// ```
/// # use pilotage_base::frames::GroundPoint;
/// use pilotage_flight::{Channel, ChannelName, Flight, Frame, StartFix};
/// use pilotage_raster::camera::CameraModel;
///
/// # let position = GroundPoint::new(0.0, 0.0);
/// let (times, values) = (vec![0.0, 10.0], vec![18.0, 20.0]);
/// let flight = Flight {
///     name: "two readings and a frame".to_owned(),
///     camera: CameraModel::pinhole(640, 480, 1.0),
///     channels: vec![Channel { name: ChannelName::Airspeed, times, values }],
///     frames: vec![Frame { time: 12.0, name: "1.jpg".to_owned(), stored_turn: 0.0 }],
/// #     start: StartFix { time: 0.0, position, standard_deviation: 5.0 },
/// #     frame_on_globe: None,
/// #     ground_down: 0.0,
/// #     truth: None,
/// };
/// assert_eq!(flight.value(ChannelName::Airspeed, 5.0), Some(19.0));
/// assert_eq!(flight.span(), (0.0, 12.0));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Flight {
    /// Name for people.
    pub name: String,
    /// The world frame on the globe, where known.
    pub frame_on_globe: Option<LocalFrame>,
    /// The camera.
    pub camera: CameraModel,
    /// Down coordinate of the ground plane in the world frame, metres.
    pub ground_down: f64,
    /// Measured series.
    pub channels: Vec<Channel>,
    /// Frames in time order.
    pub frames: Vec<Frame>,
    /// Fix at which navigation begins.
    pub start: StartFix,
    /// True states of the flight, where known.
    pub truth: Option<Truth>,
}

impl Flight {
    /// Name by which this flight is known from others, also from those of the same name: with where it starts, and where the
    /// carrier of its camera truly was at an early frame, if that is known. Other wind or other gusts change that; another
    /// camera, other times of its pictures and laps that are added do not.
    ///
    /// ```
    /// # use pilotage_base::frames::GroundPoint;
    /// # use pilotage_flight::{Flight, StartFix};
    /// # use pilotage_raster::camera::CameraModel;
    /// # let flight = Flight {
    /// #     name: "Route".to_owned(),
    /// #     camera: CameraModel::pinhole(640, 480, 1.0),
    /// #     channels: Vec::new(),
    /// #     frames: Vec::new(),
    /// #     start: StartFix { time: 0.0, position: GroundPoint::new(12.5, -3.0), standard_deviation: 5.0 },
    /// #     frame_on_globe: None,
    /// #     ground_down: 0.0,
    /// #     truth: None,
    /// # };
    /// // Of a flight that starts 12.5 m north and 3 m west of the origin of a world that lies nowhere.
    /// assert_eq!(flight.identity(), "Route from 12.5 m, -3.0 m");
    /// ```
    pub fn identity(&self) -> String {
        let place = self.told_place(&self.start.position);
        let frames = self.truth.as_ref().map_or(&[][..], |truth| &truth.frames);
        let early = frames.get(EARLY_FRAME).or(frames.last());
        let over = early.map_or_else(String::new, |early| {
            let place = GroundPoint::new(early.position.x, early.position.y);
            format!(" over {}", self.told_place(&place))
        });
        format!("{} from {place}{over}", self.name)
    }

    /// A place in words, to 0.1 m: on the globe where that is known.
    fn told_place(&self, place: &GroundPoint) -> String {
        // Zero has no sign.
        let rounded = |value: f64, steps: f64| (value * steps).round() / steps + 0.0;
        let metres = || {
            let [north, east] = [place.north, place.east].map(|value| rounded(value, 10.0));
            format!("{north:.1} m, {east:.1} m")
        };
        self.frame_on_globe.map_or_else(metres, |frame| {
            let geodetic = frame.geodetic_from_ground(place);
            let angles = [geodetic.latitude, geodetic.longitude].map(f64::to_degrees);
            let [latitude, longitude] = angles.map(|value| rounded(value, 1e6));
            format!("{latitude:.6}°, {longitude:.6}°")
        })
    }

    /// The series of that name.
    pub fn channel(&self, name: ChannelName) -> Option<&Channel> {
        self.channels.iter().find(|c| c.name == name)
    }

    /// Interpolated value of a series, `None` where there is none.
    pub fn value(&self, name: ChannelName, time: f64) -> Option<f64> {
        self.channel(name)?.interpolated(time)
    }

    /// The flight without the series of inertial sensors, which are most of its bytes: for those who look at
    /// it and do not navigate it.
    #[must_use]
    pub fn without_inertial(&self) -> Self {
        let kept = |channel: &&Channel| !channel.name.is_inertial();
        Self {
            name: self.name.clone(),
            frame_on_globe: self.frame_on_globe,
            camera: self.camera.clone(),
            ground_down: self.ground_down,
            channels: self.channels.iter().filter(kept).cloned().collect(),
            frames: self.frames.clone(),
            start: self.start,
            truth: self.truth.clone(),
        }
    }

    /// Measured attitude at `time`; missing roll and pitch count as level.
    pub fn attitude(&self, time: f64) -> Option<Attitude> {
        Some(Attitude {
            roll: self.value(ChannelName::Roll, time).unwrap_or(0.0),
            pitch: self.value(ChannelName::Pitch, time).unwrap_or(0.0),
            yaw: self.value(ChannelName::Heading, time)?,
        })
    }

    /// The camera as it took frame `index`: a picture stored turned is one from a turned mount. The camera
    /// as it is if there is no such frame.
    pub fn camera_of_frame(&self, index: usize) -> CameraModel {
        match self.frames.get(index) {
            Some(frame) if frame.stored_turn != 0.0 => self.camera.stored_turned(frame.stored_turn),
            _ => self.camera.clone(),
        }
    }

    /// First and last time at which anything was measured, seconds.
    pub fn span(&self) -> (f64, f64) {
        let channels = self
            .channels
            .iter()
            .flat_map(|c| [c.times.first(), c.times.last()]);
        let frames = [self.frames.first(), self.frames.last()];
        channels
            .flatten()
            .copied()
            .chain(frames.into_iter().flatten().map(|f| f.time))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), t| {
                (a.min(t), b.max(t))
            })
    }
}
