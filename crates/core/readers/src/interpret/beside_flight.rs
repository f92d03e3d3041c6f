//! A log beside the flight that was made of it already.

use nalgebra::Point3;

use super::flight::all_series;
use super::{InterpretError, MeasuredSeries, RoleSeries};
use crate::log::Log;
use pilotage_flight::{ChannelName, Flight, TruthState};

/// Series and track measured in a flight that was not made of its log.
#[derive(Clone, Debug)]
pub struct BesideFlight {
    found: Vec<RoleSeries>,
    track: Vec<TruthState>,
    trouble: Option<InterpretError>,
}

impl BesideFlight {
    /// Series and track measured in the flight.
    pub fn measured(&self) -> MeasuredSeries<'_> {
        MeasuredSeries {
            found: &self.found,
            track: &self.track,
            trouble: self.trouble.as_ref(),
        }
    }
}

/// Roles of the series of `log`, of which `flight` was made otherwise: of tables by what people said of their
/// columns, or of photos.
///
/// The track is that of the satellite receiver where it has one, else the truth of the flight.
pub fn log_of_flight(log: &Log, flight: &Flight) -> BesideFlight {
    let has_none = |name| flight.channel(name).is_none_or(|c| c.times.is_empty());
    let name = || log.name.clone();
    let trouble = if has_none(ChannelName::Heading) {
        Some(InterpretError::NoHeading { log: name() })
    } else if has_none(ChannelName::HeightAboveGround) {
        Some(InterpretError::NoHeight { log: name() })
    } else {
        None
    };
    BesideFlight {
        found: all_series(log),
        track: track(flight),
        trouble,
    }
}

/// Track of the receiver, with heights above its first; no attitude and no wind.
fn track(flight: &Flight) -> Vec<TruthState> {
    let channel = |name| flight.channel(name);
    let pair = channel(ChannelName::GpsNorth).zip(channel(ChannelName::GpsEast));
    let Some((north, east)) = pair.filter(|(north, _)| !north.times.is_empty()) else {
        let truth = flight.truth.as_ref();
        return truth.map_or_else(Vec::new, |truth| truth.states.clone());
    };
    let heights = [
        ChannelName::GpsHeight,
        ChannelName::BarometricHeight,
        ChannelName::HeightAboveGround,
    ];
    let height = heights.into_iter().find_map(channel);
    let first = height.and_then(|height| height.interpolated(north.times[0]));
    let mut states: Vec<TruthState> = Vec::with_capacity(north.times.len());
    for (time, north) in north.times.iter().zip(&north.values) {
        let Some(east) = east.latest(*time) else {
            continue;
        };
        let height = height.and_then(|height| height.interpolated(*time));
        let up = height
            .zip(first)
            .map_or(0.0, |(height, first)| height - first);
        if states.last().is_none_or(|last| *time > last.time) {
            states.push(TruthState {
                time: *time,
                position: Point3::new(*north, east, -up),
                attitude: None,
                wind: None,
            });
        }
    }
    states
}
