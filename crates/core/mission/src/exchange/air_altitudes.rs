//! Altitudes of routes in formats without landings.

use crate::mission::{Route, WayPointAction};
use pilotage_base::frames::Altitude;

/// The altitude of each way-point, of a landing that of the way-point before it: flown to as a way-point, a place on the
/// ground would be the end of a slant into it.
pub(super) fn altitudes_in_the_air(route: &Route) -> Vec<Altitude> {
    let mut before = None;
    let altitude = |way_point: &crate::mission::WayPoint| {
        let lands = way_point.action == WayPointAction::Land;
        let altitude = before.filter(|_| lands).unwrap_or(way_point.altitude);
        before = Some(altitude);
        altitude
    };
    route.way_points.iter().map(altitude).collect()
}
