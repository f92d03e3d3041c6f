//! Where people begin.

use std::collections::BTreeMap;

use pilotage_core::frames::Geodetic;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::NavigatorSettings;

/// A mission with nothing in it.
pub(super) fn empty_mission() -> Mission {
    Mission {
        name: "New mission".into(),
        origin: Geodetic::from_degrees(0.0, 0.0, 0.0),
        map: None,
        landmarks: Vec::new(),
        routes: Vec::new(),
        no_fly: Vec::new(),
        labels: Vec::new(),
        camera: None,
        camera_to_log: None,
        navigator: NavigatorSettings::default(),
        properties: BTreeMap::new(),
    }
}
