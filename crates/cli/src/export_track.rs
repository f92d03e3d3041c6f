//! `pilotage export --track`: where a log flew, in formats that maps and globes read.

use std::path::Path;

use pilotage_core::exchange::{FlownPoint, FlownTrack, FlownValues, Format, write_flown};
use pilotage_core::flight::expression::TimedSamples;
use pilotage_core::flight::interpret::{
    Navigation, Role, estimated_places, flight_from_log, places,
};
use pilotage_core::flight::log::{Log, Topic};
use pilotage_core::flight::{ChannelName, Flight};
use pilotage_core::frames::{Geodetic, GroundPoint, LocalFrame};
use pilotage_core::navigator::Run;
use pilotage_jobs::{SeriesName, log_samples, values_along};

use crate::CommandResult;
use crate::opening::OpenedPath;

/// Source of the places of a track.
#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum TrackKind {
    /// The satellite receiver.
    Gps,
    /// The autopilot's own estimate: POS or XKF1 of ArduPilot, `vehicle_global_position` of PX4, `GLOBAL_POSITION_INT`.
    Ekf,
}

impl TrackKind {
    fn words(self) -> &'static str {
        match self {
            Self::Gps => "GPS",
            Self::Ekf => "autopilot",
        }
    }
}

/// The track of what was opened, with the values of `channel` (`TOPIC.FIELD`, or what is computed of such) beside its places: at each the last
/// value before it.
///
/// # Errors
/// A flight without places of that kind, or without such a field.
pub fn track(
    opened: OpenedPath,
    kind: TrackKind,
    channel: Option<&str>,
) -> Result<FlownTrack, String> {
    let (log, places, has_height) = match opened {
        OpenedPath::Log(log, _) => {
            let interpreted = flight_from_log(&log);
            let found = interpreted.measured().found;
            let (by, height) = match kind {
                TrackKind::Gps => (Navigation::Gps, Role::GpsHeight),
                TrackKind::Ekf => (Navigation::Autopilot, Role::AutopilotHeight),
            };
            let has_height = found.iter().any(|series| series.role == height);
            if kind == TrackKind::Gps
                && let Some(source) = estimated_places(found)
            {
                return Err(format!(
                    "{}: no places by a satellite receiver in it; --track ekf writes the autopilot's own ({source})",
                    log.name
                ));
            }
            (*log, places(found, by), has_height)
        }
        OpenedPath::Folder(folder) | OpenedPath::Tables(folder) => {
            let (places, has_height) = of_flight(&folder.flight, kind);
            (folder.log(), places, has_height)
        }
        OpenedPath::Nothing(told) => return Err(told),
    };
    if places.is_empty() {
        let words = kind.words();
        return Err(format!("{}: no places by the {words} in it", log.name));
    }
    let series = channel.map(|name| series_called(&log, name)).transpose()?;
    let times: Vec<f64> = places.iter().map(|(time, _)| *time).collect();
    let values = series.as_ref().map(|series| values_along(series, &times));
    let values = values.unwrap_or_else(|| vec![None; times.len()]);
    let points = places.into_iter().zip(values);
    let points = points.map(|((time, place), value)| FlownPoint { time, place, value });
    Ok(FlownTrack {
        name: format!("{}, {}", log.name, kind.words()),
        utc_at_zero: log.utc_at_zero,
        has_height,
        points: points.collect(),
        values: channel.zip(series).map(|(name, series)| FlownValues {
            name: name.to_owned(),
            unit: series.unit,
        }),
    })
}

/// Times and places of a flight that was made of tables or photos, and whether their heights mean anything.
fn of_flight(flight: &Flight, kind: TrackKind) -> (Vec<(f64, Geodetic)>, bool) {
    let names = match kind {
        TrackKind::Gps => [
            ChannelName::GpsNorth,
            ChannelName::GpsEast,
            ChannelName::GpsHeight,
        ],
        TrackKind::Ekf => [
            ChannelName::AutopilotNorth,
            ChannelName::AutopilotEast,
            ChannelName::AutopilotHeight,
        ],
    };
    let [north, east, height] = names.map(|name| flight.channel(name));
    let (Some(frame), Some(north), Some(east)) = (flight.frame_on_globe, north, east) else {
        return (Vec::new(), false);
    };
    let pairs = north.times.iter().zip(&north.values);
    let place = |(time, north): (&f64, &f64)| {
        let ground = GroundPoint::new(*north, east.interpolated(*time)?);
        let height = height.and_then(|height| height.interpolated(*time));
        let place = frame.geodetic_from_ground(&ground);
        Some((
            *time,
            Geodetic {
                height: height.unwrap_or(0.0),
                ..place
            },
        ))
    };
    (pairs.filter_map(place).collect(), height.is_some())
}

/// Place and date of a replayed flight.
#[derive(Clone, Copy)]
pub struct FlownWhere {
    /// Origin of the world of its mission, which counts where the flight itself lies nowhere on the globe.
    pub origin: Geodetic,
    /// Universal time at its zero, seconds since 1970, where that is known.
    pub utc_at_zero: Option<f64>,
}

/// Writes the estimate of a run as a track without heights, in the format that the file's ending names.
///
/// # Errors
/// An ending of no format that holds tracks.
pub fn write_estimate(flight: &Flight, run: &Run, at: FlownWhere, path: &Path) -> CommandResult {
    let name = path.to_string_lossy();
    let format = Format::of_name(&name)
        .filter(|format| format.holds_tracks())
        .ok_or_else(|| {
            format!(
                "{name}: a track ends in one of {}",
                Format::track_extensions()
            )
        })?;
    let frame = flight.frame_on_globe;
    let frame = frame.unwrap_or_else(|| LocalFrame::new(at.origin));
    let track = run.estimated_track(&flight.name, &frame, at.utc_at_zero);
    let written = write_flown(format, &track)?;
    crate::notes::tell(&written.notes);
    Ok(crate::files::write_whole(path, written.bytes)?)
}

/// The series of a log that a name says: TOPIC.FIELD, else an expression over fields and roles.
fn series_called(log: &Log, name: &str) -> Result<TimedSamples, String> {
    let is_topic = |topic: &&Topic, wanted: &str| {
        !topic.is_empty() && (topic.name.to_string() == wanted || topic.name.name == wanted)
    };
    // Names of topics and of fields may have dots in them.
    let mut dots = name.match_indices('.').map(|(at, _)| name.split_at(at));
    let found = dots.find_map(|(topic, field)| {
        let topic = log.topics.iter().find(|it| is_topic(it, topic))?;
        let field = topic.field(&field[1..])?;
        field.kind.is_number().then(|| SeriesName {
            topic: topic.name.clone(),
            field: field.name.clone(),
        })
    });
    if let Some(found) = found {
        return log_samples(log, &found);
    }
    if let Ok(computed) = log_samples(log, &SeriesName::expression(name)) {
        return Ok(computed);
    }
    let fields = log
        .topics
        .iter()
        .filter(|topic| name.split('.').next().is_some_and(|n| is_topic(topic, n)))
        .flat_map(|topic| topic.fields.iter().filter(|f| f.kind.is_number()))
        .map(|field| field.name.as_str());
    let fields: Vec<&str> = fields.collect();
    Err(if fields.is_empty() {
        format!(
            "{}: no field {name}; say TOPIC.FIELD, with a topic of `pilotage inspect --counts`, or what is computed of such: \
             2 * TOPIC.FIELD",
            log.name
        )
    } else {
        format!(
            "{}: no field {name}; there are {}",
            log.name,
            fields.join(", ")
        )
    })
}
