//! A flown track, before it is written into a format.

use serde::{Deserialize, Serialize};

use crate::mission::degrees;
use pilotage_base::frames::Geodetic;
use pilotage_base::text::utc_text;

/// A place of a track.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FlownPoint {
    /// Seconds in the track's time base.
    pub time: f64,
    /// The place; its height is in metres above sea level as whoever measured it counts.
    pub place: Geodetic,
    /// Value of the chosen series there, if it has one.
    pub value: Option<f64>,
}

/// The series whose values stand beside the places.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FlownValues {
    /// Name for people: `ATT.Roll`.
    pub name: String,
    /// Unit of its values, or empty.
    pub unit: String,
}

impl FlownValues {
    /// Name and unit in one: `ATT.Roll [deg]`.
    pub(super) fn title(&self) -> String {
        if self.unit.is_empty() {
            self.name.clone()
        } else {
            format!("{} [{}]", self.name, self.unit)
        }
    }
}

/// A flown track.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FlownTrack {
    /// Name for people.
    pub name: String,
    /// Seconds since 1970 (UTC) at time zero, where known.
    pub utc_at_zero: Option<f64>,
    /// Whether heights mean anything.
    pub has_height: bool,
    /// The series beside the places, if one was chosen.
    pub values: Option<FlownValues>,
    /// Places in order of time.
    pub points: Vec<FlownPoint>,
}

impl FlownTrack {
    /// Date and time of a point as ISO 8601 writes them, where known.
    pub(super) fn utc(&self, point: &FlownPoint) -> Option<String> {
        Some(utc_text(self.utc_at_zero? + point.time))
    }
}

/// A number that formats may hold.
pub(super) fn finite(value: Option<f64>) -> Option<f64> {
    value.filter(|v| v.is_finite())
}

/// Latitude and longitude in degrees, as they are written.
pub(super) fn angles(place: &Geodetic) -> (String, String) {
    (
        degrees(place.latitude.to_degrees()),
        degrees(place.longitude.to_degrees()),
    )
}
