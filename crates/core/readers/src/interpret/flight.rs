//! The flight that a log tells of.

use nalgebra::Point3;

use super::{Navigation, Role, RoleSeries, estimated_places, places, series};
use crate::log::Log;
use pilotage_base::frames::{Geodetic, LocalFrame};
use pilotage_flight::{Channel, ChannelName, Flight, StartFix, Truth, TruthState};
use pilotage_raster::camera::CameraModel;

/// Standard deviation per axis of a position by satellite navigation at the start, metres.
const GPS_DEVIATION: f64 = 5.0;

/// Series and track measured in a flight, by role.
#[derive(Clone, Copy, Debug)]
pub struct MeasuredSeries<'a> {
    /// Every role that was found.
    pub found: &'a [RoleSeries],
    /// The track of the satellite receiver, or of the autopilot where no receiver knows its place; heights above its first.
    pub track: &'a [TruthState],
    /// Why there is no flight to be navigated, if so.
    pub trouble: Option<&'a InterpretError>,
}

/// Roles of the series of a log, and the track of its flight.
#[derive(Clone, Debug)]
pub struct Interpreted {
    /// Every role that was found.
    pub found: Vec<RoleSeries>,
    /// The flight without its measured series, or why nobody knows where it was.
    bare: Result<Flight, InterpretError>,
    /// Error that keeps the flight from being navigated, if its track is known.
    trouble: Option<InterpretError>,
}

impl Interpreted {
    /// Series and track measured in the flight.
    pub fn measured(&self) -> MeasuredSeries<'_> {
        let truth = self.bare.as_ref().ok().and_then(|f| f.truth.as_ref());
        MeasuredSeries {
            found: &self.found,
            track: truth.map_or(&[], |truth| &truth.states),
            trouble: self.bare.as_ref().err().or(self.trouble.as_ref()),
        }
    }

    /// The flight, whether or not it can be navigated. The series become its channels without being copied: those of
    /// a long log are large.
    ///
    /// # Errors
    /// Nobody knows where it was.
    pub fn into_flight(self) -> Result<Flight, InterpretError> {
        let mut flight = self.bare?;
        let states = flight.truth.as_ref().map_or(&[][..], |t| &t.states);
        let track = |name, part: fn(&Point3<f64>) -> f64| Channel {
            name,
            times: states.iter().map(|s| s.time).collect(),
            values: states.iter().map(|s| part(&s.position)).collect(),
        };
        let mut derived = Vec::new();
        if estimated_places(&self.found).is_none() {
            derived.push(track(ChannelName::GpsNorth, |p| p.x));
            derived.push(track(ChannelName::GpsEast, |p| p.y));
        }
        let has_height = |s: &RoleSeries| s.role == Role::HeightAboveGround;
        if !self.found.iter().any(has_height) {
            derived.push(height_above_start(&self.found, states));
        }
        derived.extend(autopilot_track(&self.found, flight.frame_on_globe.as_ref()));
        let mut found = self.found;
        let stand_in: Vec<Role> = found
            .iter()
            .filter(|series| series.stands_in(&found))
            .map(|series| series.role)
            .collect();
        found.retain(|series| !stand_in.contains(&series.role));
        flight.channels = found.into_iter().filter_map(channel).collect();
        flight.channels.extend(derived);
        Ok(flight)
    }
}

/// Why a log tells of no flight that can be navigated.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum InterpretError {
    /// There is no position to begin with.
    #[error("{log}: no position by satellite navigation in it, so the starting point is unknown")]
    NoPosition {
        /// Name of the log.
        log: String,
    },
    /// There is no heading.
    #[error("{log}: no heading in it, so dead reckoning has no direction")]
    NoHeading {
        /// Name of the log.
        log: String,
    },
    /// There is no height.
    #[error("{log}: no height in it, so the scale of the pictures is unknown")]
    NoHeight {
        /// Name of the log.
        log: String,
    },
}

/// Reads the series of every role, of which [`Interpreted::into_flight`] makes a flight.
///
/// World is the tangent plane at the first fix; heights are above the ground there. The truth is the track
/// of the satellite receiver, or the autopilot's own estimate where no receiver knows its place: it is what there is, and no
/// better than it. There are channels of a receiver only where one measured.
///
/// ```
/// use pilotage_flight::ChannelName;
/// # use pilotage_readers::bytes::MemoryBytes;
/// use pilotage_readers::interpret::flight_from_log;
/// use pilotage_readers::log::read_log;
///
/// let text = "FMT, 1, 50, GPS, QBLLf, TimeUS,Status,Lat,Lng,Alt\n\
///             FMT, 2, 50, ATT, Qc, TimeUS,Yaw\n\
///             GPS, 1000000, 3, 46.8, -92.0, 200\nATT, 1000000, 90\n\
///             GPS, 2000000, 3, 46.8001, -92.0, 200\nATT, 2000000, 91\n";
/// let log = read_log(&MemoryBytes::new("flight.log", text.as_bytes()))?.ok_or("no log")?;
/// let flight = flight_from_log(&log).into_flight()?;
/// // A ten-thousandth of a degree of latitude is 11.1 m.
/// let north = flight.value(ChannelName::GpsNorth, 2.0).ok_or("no track")?;
/// assert!((north - 11.1).abs() < 0.05);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn flight_from_log(log: &Log) -> Interpreted {
    let found = all_series(log);
    let has_heading = found.iter().any(|s| s.role == Role::Heading);
    let no_heading = || InterpretError::NoHeading {
        log: log.name.clone(),
    };
    Interpreted {
        bare: bare_flight(log, &found),
        trouble: (!has_heading).then(no_heading),
        found,
    }
}

/// The series of every role, in the order in which people read them.
pub(super) fn all_series(log: &Log) -> Vec<RoleSeries> {
    let roles = Role::ALL.into_iter();
    roles.filter_map(|role| series(log, role)).collect()
}

fn bare_flight(log: &Log, found: &[RoleSeries]) -> Result<Flight, InterpretError> {
    let name = || log.name.clone();
    let fixes = places(found, Navigation::Gps);
    let Some((first_time, first)) = fixes.first().copied() else {
        return Err(InterpretError::NoPosition { log: name() });
    };
    let frame = LocalFrame::new(first);
    let states = fixes
        .iter()
        .map(|(time, place)| {
            let ground = frame.ground_from_geodetic(place);
            let down = first.height - place.height;
            TruthState {
                time: *time,
                position: Point3::new(ground.north, ground.east, down),
                attitude: None,
                wind: None,
            }
        })
        .collect();
    Ok(Flight {
        name: name(),
        frame_on_globe: Some(frame),
        camera: CameraModel::pinhole(640, 480, 60.0_f64.to_radians()),
        ground_down: 0.0,
        channels: Vec::new(),
        frames: Vec::new(),
        start: StartFix {
            time: first_time,
            position: pilotage_base::frames::GroundPoint::new(0.0, 0.0),
            standard_deviation: GPS_DEVIATION,
        },
        truth: Some(Truth {
            states,
            frames: Vec::new(),
        }),
    })
}

/// Channels of the autopilot's own estimate, north and east in the flight's world `frame`; none where that is not known.
fn autopilot_track(found: &[RoleSeries], frame: Option<&LocalFrame>) -> Vec<Channel> {
    let places = places(found, Navigation::Autopilot).into_iter();
    let on_ground = |(time, place): (f64, Geodetic)| {
        let ground = frame?.ground_if_near(&place)?;
        Some((time, ground.north, ground.east))
    };
    let (mut times, mut norths, mut easts) = (Vec::new(), Vec::new(), Vec::new());
    for (time, north, east) in places.filter_map(on_ground) {
        times.push(time);
        norths.push(north);
        easts.push(east);
    }
    if times.is_empty() {
        return Vec::new();
    }
    let track = |name, times, values| Channel {
        name,
        times,
        values,
    };
    vec![
        track(ChannelName::AutopilotNorth, times.clone(), norths),
        track(ChannelName::AutopilotEast, times, easts),
    ]
}

fn channel(series: RoleSeries) -> Option<Channel> {
    Some(Channel {
        name: series.role.channel()?,
        times: series.times,
        values: series.values,
    })
}

/// Height above where the flight began: by air pressure where there is a barometer, else by the receiver.
fn height_above_start(found: &[RoleSeries], states: &[TruthState]) -> Channel {
    let barometer = found.iter().find(|s| s.role == Role::BarometricHeight);
    let (times, values): (Vec<f64>, Vec<f64>) = match barometer {
        Some(series) => {
            let start = states.first().and_then(|s| series.at(s.time));
            let zero = start.unwrap_or(series.values[0]);
            let values = series.values.iter().map(|v| v - zero).collect();
            (series.times.clone(), values)
        }
        None => states.iter().map(|s| (s.time, -s.position.z)).unzip(),
    };
    Channel {
        name: ChannelName::HeightAboveGround,
        times,
        values,
    }
}
