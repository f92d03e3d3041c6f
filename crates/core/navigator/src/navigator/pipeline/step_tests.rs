//! Steps without a frame, in flights by the settings of a mission.

use std::sync::Arc;

use pilotage_base::frames::GroundPoint;
use pilotage_flight::{Channel, ChannelName, Flight, NoPictures, StartFix};
use pilotage_mission::settings::VehicleChoice;
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

#[test]
fn a_velocity_that_falls_silent_on_a_leg_is_told_and_the_ellipse_holds_the_next_leg() {
    let channels = vec![
        channel(ChannelName::Heading, 0.0, (0.0, 30.0)),
        channel(ChannelName::VelocityNorth, 0.6, (0.0, 20.0)),
        channel(ChannelName::VelocityEast, 0.0, (0.0, 20.0)),
    ];
    let mut settings = NavigatorSettings {
        vehicle: VehicleChoice::VelocityDriven,
        ..NavigatorSettings::default()
    };
    // Of this vehicle the bias of its velocity and its walk.
    (settings.start.wind, settings.process.wind) = (0.1, 0.01);
    let run = navigator(flight(channels, 0.0), &settings)
        .fly(&mut NoPictures, &|| 0.0)
        .unwrap();
    let last = run.steps.last().unwrap();
    // It turned to the east where the velocity fell silent: 12 m north, 6 m east.
    let off = last.after.position().distance(&GroundPoint::new(12.0, 6.0));
    assert!(
        off < last.radius_held(),
        "{off} m, {} m",
        last.radius_held()
    );
    let told: Vec<String> = last.doubts.iter().map(super::super::Doubt::words).collect();
    assert_eq!(told[0], "velocity north is silent since 21.5 s");
    let before = run.step_at(20.0).unwrap();
    assert!(before.doubts.is_empty() && before.radius_held() < 10.0);
}

#[test]
fn a_first_reading_just_before_the_start_is_one_at_the_start() {
    let mut flight = airplane();
    flight.start.time = 1.0;
    for channel in &mut flight.channels {
        let early = channel.times.partition_point(|time| *time < 0.95);
        channel.times.drain(..early);
        channel.values.drain(..early);
        channel.times[0] = 1.0 - 5e-7;
    }
    let run = navigator(flight, &NavigatorSettings::default())
        .fly(&mut NoPictures, &|| 0.0)
        .unwrap();
    assert_eq!(run.steps.len(), 41);
    assert!(run.steps[0].dt == 0.0 && (run.steps[1].dt - 0.1).abs() < 1e-9);
}
