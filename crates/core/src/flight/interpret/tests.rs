//! Logs that are made here, and the flights that they tell of.

use std::f64::consts::FRAC_PI_2;

use super::*;
use crate::flight::ChannelName;
use crate::flight::log::{FieldKind, FieldLayout, Log, LogFormat, TopicName};

/// Adds a topic of double-precision numbers: names with units, and rows that begin with their time.
fn add(log: &mut Log, name: &str, fields: &[(&str, &str)], rows: &[Vec<f64>]) {
    let layouts = || {
        let fields = fields.iter().enumerate();
        let layout = |(i, (name, unit)): (usize, &(&str, &str))| FieldLayout {
            unit: (*unit).to_owned(),
            ..FieldLayout::plain(*name, FieldKind::F64, 8 * i)
        };
        fields.map(layout).collect()
    };
    let place = log.topic_or_new(&TopicName::single(name), layouts);
    for row in rows {
        let bytes: Vec<u8> = row[1..].iter().flat_map(|v| v.to_le_bytes()).collect();
        log.topics[place].push(row[0], &bytes);
    }
}

/// A flight eastward at 20 m/s over Zurich, with its fixes once a second.
fn eastward() -> Log {
    let mut log = Log::new("east.bin", LogFormat::Dataflash);
    let attitude: Vec<_> = (0..50)
        .map(|i| vec![0.1 * f64::from(i), 0.0, 5.0, 90.0])
        .collect();
    let fields = [("Roll", "deg"), ("Pitch", "deg"), ("Yaw", "degheading")];
    add(&mut log, "ATT", &fields, &attitude);
    let degrees = 20.0 / 76_000.0;
    let fixes: Vec<_> = (0..6)
        .map(|i| {
            let i = f64::from(i);
            vec![i, 3.0, 47.0, 8.0 + i * degrees, 500.0 + i, 20.0, 90.0]
        })
        .collect();
    let fields = [
        ("Status", ""),
        ("Lat", "deglatitude"),
        ("Lng", "deglongitude"),
        ("Alt", "m"),
        ("Spd", "m/s"),
        ("GCrs", "degheading"),
    ];
    add(&mut log, "GPS", &fields, &fixes);
    log
}

#[test]
fn a_flight_begins_at_its_first_fix_and_goes_where_its_fixes_go() {
    let log = eastward();
    let flight = flight_from_log(&log).flight.unwrap();
    let truth = flight.truth.as_ref().unwrap();
    let last = truth.states.last().unwrap().position;
    assert!((last.y - 100.0).abs() < 0.2 && last.x.abs() < 0.1, "{last}");
    assert!((last.z + 5.0).abs() < 1e-9);
    assert_eq!(flight.value(ChannelName::HeightAboveGround, 5.0), Some(5.0));
    let heading = flight.value(ChannelName::Heading, 1.0).unwrap();
    assert!((heading - FRAC_PI_2).abs() < 1e-12);
    let velocity = series(&log, Role::GpsVelocityEast).unwrap();
    assert!((velocity.values[0] - 20.0).abs() < 1e-12);
    assert_eq!(velocity.source, "GPS.Spd, GCrs");
}

#[test]
fn fixes_without_a_fix_do_not_count() {
    let mut log = Log::new("none.bin", LogFormat::Dataflash);
    let fields = [("Status", ""), ("Lat", "deg"), ("Lng", "deg")];
    add(&mut log, "GPS", &fields, &[vec![0.0, 1.0, 47.0, 8.0]]);
    add(&mut log, "ATT", &[("Yaw", "deg")], &[vec![0.0, 10.0]]);
    let cause = flight_from_log(&log).flight.unwrap_err();
    assert!(matches!(cause, InterpretError::NoPosition { .. }));
    assert!(cause.to_string().starts_with("none.bin: "));
}

#[test]
fn times_that_go_back_and_numbers_beyond_reason_are_counted_and_left_out() {
    let mut log = Log::new("odd.bin", LogFormat::Dataflash);
    let rows = [
        vec![0.0, 10.0],
        vec![1.0, f64::NAN],
        vec![2.0, 20.0],
        vec![1.5, 30.0],
        vec![3.0, 1e9],
        vec![4.0, -170.0],
    ];
    add(&mut log, "ATT", &[("Yaw", "deg")], &rows);
    let heading = series(&log, Role::Heading).unwrap();
    assert_eq!(heading.times, [0.0, 2.0, 4.0]);
    assert_eq!((heading.implausible, heading.out_of_order), (2, 1));
    assert!((heading.values[2] + 170.0_f64.to_radians()).abs() < 1e-12);
}

#[test]
fn a_sensor_that_logs_one_number_for_ever_gives_way_to_one_that_lives() {
    let mut log = eastward();
    let dead: Vec<_> = (0..5).map(|i| vec![f64::from(i), 0.0]).collect();
    add(&mut log, "ARSP", &[("Airspeed", "m/s")], &dead);
    let found = series(&log, Role::Airspeed).unwrap();
    assert_eq!(found.source, "ARSP.Airspeed");
    let alive: Vec<_> = (0..5)
        .map(|i| vec![f64::from(i), 18.0 + f64::from(i)])
        .collect();
    add(&mut log, "NTUN", &[("Arspd", "")], &alive);
    let found = series(&log, Role::Airspeed).unwrap();
    assert_eq!(found.source, "NTUN.Arspd");
}

#[test]
fn an_attitude_as_a_quaternion_is_turned_into_angles() {
    let mut log = Log::new("px4.ulg", LogFormat::Ulog);
    let half = 0.5 * FRAC_PI_2;
    let fields = [("q[0]", ""), ("q[1]", ""), ("q[2]", ""), ("q[3]", "")];
    let east = vec![0.0, half.cos(), 0.0, 0.0, half.sin()];
    let rolled = vec![1.0, half.cos(), half.sin(), 0.0, 0.0];
    add(&mut log, "vehicle_attitude", &fields, &[east, rolled]);
    let heading = series(&log, Role::Heading).unwrap();
    assert!((heading.values[0] - FRAC_PI_2).abs() < 1e-12);
    let roll = series(&log, Role::Roll).unwrap();
    assert!((roll.values[1] - FRAC_PI_2).abs() < 1e-12);
}

#[test]
fn a_wind_from_the_west_blows_east() {
    let mut log = Log::new("ground.tlog", LogFormat::Tlog);
    let fields = [("direction", "deg"), ("speed", "m/s")];
    let rows = [vec![0.0, 270.0, 8.0], vec![1.0, 270.0, 9.0]];
    add(&mut log, "WIND", &fields, &rows);
    let east = series(&log, Role::WindEast).unwrap();
    assert!((east.values[0] - 8.0).abs() < 1e-12);
    let north = series(&log, Role::WindNorth).unwrap();
    assert!(north.values[0].abs() < 1e-12);
}
