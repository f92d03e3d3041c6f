//! The place from which the filter of `ArduPilot` counts.

use crate::log::{Log, Topic};
use pilotage_base::frames::Geodetic;

/// Number of the origin of the filter among the places in rows of `ORGN`; home is another.
const OF_FILTER: f64 = 0.0;
/// Metres of a radian of latitude, as the autopilot counts: 0.011 131 884 502 145 034 m are 1e-7 degrees
/// (`AP_Common/Location.h`).
const METRES_PER_RADIAN: f64 = 0.011_131_884_502_145_034 * 1e7 * 57.295_779_513_082_32;

/// The origin of the filter, if the log tells it: angles in radians, metres above sea level.
pub(super) fn origin(log: &Log) -> Option<Geodetic> {
    let topic = log.first("ORGN")?;
    let of = |name: &str| topic.field(name).filter(|field| field.kind.is_number());
    let (kind, latitude, longitude, height) = (of("Type")?, of("Lat")?, of("Lng")?, of("Alt")?);
    let is_it = |row: &usize| topic.value(kind, *row) == Some(OF_FILTER);
    let row = (0..topic.len()).find(is_it)?;
    let value = |field| Topic::value(topic, field, row);
    Some(Geodetic::from_degrees(
        value(latitude)?,
        value(longitude)?,
        value(height)?,
    ))
}

/// The place so many metres north, east and below the origin, as the autopilot itself reckons it: on a sphere, meridians
/// as far apart as they are halfway.
pub(super) fn place(origin: &Geodetic, north: f64, east: f64, down: f64) -> Geodetic {
    let latitude = origin.latitude + north / METRES_PER_RADIAN;
    let halfway = 0.5 * (origin.latitude + latitude);
    let longitude = origin.longitude + east / (METRES_PER_RADIAN * halfway.cos());
    Geodetic {
        latitude,
        longitude: pilotage_base::frames::wrap_pi(longitude),
        height: origin.height - down,
    }
}
