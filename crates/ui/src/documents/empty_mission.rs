//! Mission with which people begin.

use pilotage_core::frames::Geodetic;
use pilotage_core::mission::Mission;

/// A mission with nothing in it.
pub fn empty_mission() -> Mission {
    Mission::new("New mission", Geodetic::from_degrees(0.0, 0.0, 0.0))
}
