//! Places in a log: by its satellite receiver, and by the autopilot's own filter.

use super::{Role, RoleSeries};
use pilotage_base::frames::Geodetic;

/// Kinds of fix from which on a position counts.
pub(super) const FLAT_FIX: f64 = 2.0;

/// Source of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Navigation {
    /// The satellite receiver; where none knows its place, the autopilot's estimate in its stead.
    Gps,
    /// The autopilot's own estimate, of satellites and inertial sensors together.
    Autopilot,
}

/// Times (seconds in the log's time base) and places of all that count, of what was found in a log: with a fix, and not at
/// 0° north, 0° east. Heights are as the log has them, metres; 0 where it has none. Empty without latitude and longitude.
pub fn places(found: &[RoleSeries], by: Navigation) -> Vec<(f64, Geodetic)> {
    let [latitude, longitude, height] = match by {
        Navigation::Gps => [Role::Latitude, Role::Longitude, Role::GpsHeight],
        Navigation::Autopilot => [
            Role::AutopilotLatitude,
            Role::AutopilotLongitude,
            Role::AutopilotHeight,
        ],
    };
    let of = |role| found.iter().find(|s: &&RoleSeries| s.role == role);
    let (Some(latitude), Some(longitude)) = (of(latitude), of(longitude)) else {
        return Vec::new();
    };
    // A fix says nothing of places that the autopilot estimates.
    let fixes = of(Role::GpsFix).filter(|_| by == Navigation::Gps && !latitude.stands_in(found));
    let heights = of(height);
    let place = |(time, latitude): (&f64, &f64)| {
        let longitude = longitude.at(*time)?;
        let is_fixed = fixes
            .and_then(|fixes| fixes.at(*time))
            .is_none_or(|fix| fix >= FLAT_FIX);
        let is_there = *latitude != 0.0 || longitude != 0.0;
        (is_fixed && is_there).then_some((
            *time,
            Geodetic {
                latitude: *latitude,
                longitude,
                height: heights.and_then(|h| h.at(*time)).unwrap_or(0.0),
            },
        ))
    };
    let pairs = latitude.times.iter().zip(&latitude.values);
    pairs.filter_map(place).collect()
}

/// Field of the log from which the places come in the stead of a receiver's: the autopilot's own estimate.
pub fn estimated_places(found: &[RoleSeries]) -> Option<&str> {
    let latitude = found.iter().find(|s| s.role == Role::Latitude)?;
    latitude
        .stands_in(found)
        .then_some(latitude.source.as_str())
}
