//! Places of other world frames on this map.

use nalgebra::Isometry3;
use pilotage_core::frames::LocalFrame;

/// Motion that brings places of the world frame `from` into that of `to`; none where either lies nowhere on the globe.
pub(crate) fn carry(to: Option<LocalFrame>, from: Option<LocalFrame>) -> Isometry3<f64> {
    to.zip(from).map_or_else(Isometry3::identity, |(to, from)| {
        to.world_from_other_world(&from)
    })
}
