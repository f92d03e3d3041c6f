//! Steps without a frame, in flights by the settings of a mission.

use std::sync::Arc;

use pilotage_base::frames::GroundPoint;
use pilotage_flight::{Channel, ChannelName, Flight, NoPictures, StartFix};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::Blank;

use super::*;

/// Readings ten times a second from `from` to `until`, seconds, which waver a little about `value`.
fn channel(name: ChannelName, value: f64, (from, until): (f64, f64)) -> Channel {
    let count = ((until - from) * 10.0).round() as u32;
    let waver = |i| if i % 2 == 0 { 1e-3 } else { -1e-3 };
    Channel {
        name,
        times: (0..=count).map(|i| from + 0.1 * f64::from(i)).collect(),
        values: (0..=count).map(|i| value + waver(i)).collect(),
    }
}

fn flight(channels: Vec<Channel>, start: f64) -> Flight {
    Flight {
        name: "without a frame".to_owned(),
        frame_on_globe: None,
        camera: CameraModel::pinhole(320, 240, 1.0),
        ground_down: 0.0,
        channels,
        frames: Vec::new(),
        start: StartFix {
            time: start,
            position: GroundPoint::default(),
            standard_deviation: 1.0,
        },
        truth: None,
    }
}

fn navigator(flight: Flight, settings: &NavigatorSettings) -> Navigator {
    let ground = KnownGround::new(Arc::new(Blank));
    Navigator::new(Arc::new(flight), &ground, settings).unwrap()
}

fn airplane() -> Flight {
    let whole = (0.0, 5.0);
    let channels = vec![
        channel(ChannelName::Airspeed, 20.0, whole),
        channel(ChannelName::Heading, 1.0, whole),
    ];
    flight(channels, 0.0)
}

#[test]
fn while_several_places_are_open_every_step_tells_of_all_of_them() {
    let settings = NavigatorSettings::default();
    let mut navigator = navigator(airplane(), &settings);
    let other = engine(&settings, GroundPoint::new(400.0, 0.0), 3.0).unwrap();
    navigator.possible = PossiblePlaces::two(0.2, other);
    let run = navigator.fly(&mut NoPictures, &|| 0.0).unwrap();
    assert_eq!(run.steps.len(), 51);
    for step in &run.steps {
        let off = step.after.position().north - step.predicted.position().north;
        assert!((off - 400.0).abs() < 1e-6, "{off}");
        // Of 400 m on one axis, with a probability of 0.2, more than 400 √0.2 = 179 m.
        let deviation = step.after.covariance[(0, 0)].sqrt();
        assert!((178.0..185.0).contains(&deviation), "{deviation}");
    }
}
