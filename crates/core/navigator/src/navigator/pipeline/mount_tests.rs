//! A camera whose mount nobody states, in flights by the settings of a mission.

use std::sync::Arc;

use pilotage_base::frames::GroundPoint;
use pilotage_flight::{Channel, ChannelName, Flight, StartFix};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::Blank;

use super::*;

fn flight() -> Flight {
    let channel = |name, value| Channel {
        name,
        times: vec![0.0, 10.0],
        values: vec![value, value],
    };
    Flight {
        name: "photos".to_owned(),
        frame_on_globe: None,
        camera: CameraModel::pinhole(320, 240, 1.0),
        ground_down: 0.0,
        channels: vec![
            channel(ChannelName::Airspeed, 20.0),
            channel(ChannelName::Heading, 1.0),
        ],
        frames: Vec::new(),
        start: StartFix {
            time: 0.0,
            position: GroundPoint::default(),
            standard_deviation: 3.0,
        },
        truth: None,
    }
}

#[test]
fn settings_that_a_mission_brings_allow_for_a_mount_that_nobody_states() {
    let settings = NavigatorSettings::default();
    let flown = |flight: Flight| {
        let ground = KnownGround::new(Arc::new(Blank));
        let navigator = Navigator::new(Arc::new(flight), &ground, &settings).unwrap();
        navigator.run_head()
    };
    let stated = flown(flight());
    assert_eq!(stated.settings.sensors, settings.sensors);
    let mut unstated = flight();
    unstated.camera.mount_deviation = 0.17;
    let unstated = flown(unstated);
    assert_eq!(unstated.settings.sensors.tilt_bias, 0.17);
    assert!(unstated.settings.sensors.roll > 0.17);
    // Both tilts of the camera are states.
    assert_eq!(unstated.state_names.len(), stated.state_names.len() + 2);
}
