//! The recorded flights of the Skywalker X-8 are read where their author left them.

use pilotage_core::flight::{ChannelName, Flight};
use pilotage_tests::recorded;

fn flight(name: &str) -> Option<Flight> {
    let folder = recorded::flight(name, "inertialnav_x8")?.expect("the flight reads");
    assert!(folder.notes.is_empty(), "{:?}", folder.notes);
    Some(folder.flight)
}

/// First and last value of a channel.
fn ends(flight: &Flight, name: ChannelName) -> (f64, f64) {
    let channel = flight.channel(name).expect("the channel is there");
    let ends = channel.values.first().zip(channel.values.last());
    ends.map(|(first, last)| (*first, *last))
        .expect("it has values")
}

#[test]
fn testlog2_is_read_with_its_gps_airspeed_attitude_and_gyros() {
    let Some(flight) = flight("testlog2") else {
        return;
    };
    assert_eq!(flight.channels.len(), 18);
    let (begin, end) = flight.span();
    assert!((begin - 13.178).abs() < 1e-9 && (end - begin - 613.1).abs() < 0.1);
    // A line of the file: 316080 ms, 11.68 m/s towards 84.64°, climbing at 0.83 m/s downwards.
    let value = |name| flight.value(name, 316.08).expect("a value");
    let course = 84.64_f64.to_radians();
    assert!((value(ChannelName::GpsVelocityNorth) - 11.68 * course.cos()).abs() < 1e-9);
    assert!((value(ChannelName::GpsVelocityEast) - 11.68 * course.sin()).abs() < 1e-9);
    assert!((value(ChannelName::GpsVelocityDown) - 0.83).abs() < 1e-9);
    assert!((value(ChannelName::GpsHeight) - 116.08).abs() < 1e-9);
    // 37.9589571° south, 144.7641404° east, from the origin at 37.95968° south, 144.7648° east.
    assert!((value(ChannelName::GpsNorth) - 80.24).abs() < 0.05);
    assert!((value(ChannelName::GpsEast) + 57.96).abs() < 0.05);
    // Gravity, while it stands on the ground with its nose up.
    let down = flight
        .value(ChannelName::AccelerationDown, 43.26)
        .expect("a value");
    assert!((down + 9.63).abs() < 0.01);
}

#[test]
fn inputfiles_px4_is_read_out_of_its_zip_without_headers() {
    let Some(flight) = flight("inputfiles_px4") else {
        return;
    };
    let (begin, end) = flight.span();
    assert!(begin.abs() < 1e-9 && (end - 150.157).abs() < 0.001);
    let (first, last) = ends(&flight, ChannelName::BarometricHeight);
    assert!((first - 423.304).abs() < 1e-3 && (last - 422.0).abs() < 1.0);
    let (north, _) = ends(&flight, ChannelName::GpsNorth);
    assert!(north.abs() < 1e-6);
    let (heading, _) = ends(&flight, ChannelName::Heading);
    assert!((heading.to_degrees() + 83.965_189).abs() < 1e-5);
    let (forward, _) = ends(&flight, ChannelName::AccelerationForward);
    assert!((forward - 1.290_418).abs() < 1e-6);
    let (velocity, _) = ends(&flight, ChannelName::GpsVelocityNorth);
    assert!((velocity - 0.21).abs() < 1e-9);
}
