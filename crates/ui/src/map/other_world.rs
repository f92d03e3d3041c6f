//! Places of other world frames on this map.

use nalgebra::Isometry3;
use pilotage_core::frames::units::EARTH_RADIUS;
use pilotage_core::frames::{Geodetic, LocalFrame};
use pilotage_jobs::WebMap;

/// Motion that brings places of the world frame `from` into that of `to`; none where either lies nowhere on the globe.
pub(crate) fn carry(to: Option<LocalFrame>, from: Option<LocalFrame>) -> Isometry3<f64> {
    to.zip(from).map_or_else(Isometry3::identity, |(to, from)| {
        to.world_from_other_world(&from)
    })
}

/// Farthest that a place may lie from the origin of a world, metres: beyond, its plane leaves the globe.
pub(crate) fn world_reach() -> f64 {
    0.5 * WebMap::area().width()
}

/// Whether the plane of the world of a frame reaches a place on the globe.
pub(crate) fn is_in_reach(frame: &LocalFrame, place: &Geodetic) -> bool {
    straight(frame, place) <= world_reach()
}

/// Distance of a place on the globe from the origin of a frame over the ground, metres.
pub(crate) fn distance_over_ground(frame: &LocalFrame, place: &Geodetic) -> f64 {
    2.0 * EARTH_RADIUS
        * (0.5 * straight(frame, place) / EARTH_RADIUS)
            .min(1.0)
            .asin()
}

/// The same through the Earth.
fn straight(frame: &LocalFrame, place: &Geodetic) -> f64 {
    let height = frame.origin.height;
    let place = Geodetic { height, ..*place };
    frame.world_from_geodetic(&place).coords.norm()
}
