//! Rows that were not measured, receivers that are preferred, and units of old and of stated numbers.

use std::fmt::Write as _;

use super::*;
use crate::bytes::MemoryBytes;
use crate::log::{FieldKind, FieldLayout, Log, LogFormat, TopicName, read_log};

/// The log of text of `ArduPilot`.
fn text_log(text: &str) -> Log {
    let source = MemoryBytes::new("a.log", text.as_bytes());
    read_log(&source).unwrap().unwrap()
}

/// A log with a topic of doubles: of that schema, named so, rows that begin with their time.
pub(super) fn with(log: &mut Log, name: &str, schema: &str, fields: &[&str], rows: &[Vec<f64>]) {
    let layouts = || {
        let fields = fields.iter().enumerate();
        let layout = |(i, name): (usize, &&str)| FieldLayout::plain(*name, FieldKind::F64, 8 * i);
        fields.map(layout).collect()
    };
    let place = log.topic_or_new(&TopicName::single(name), layouts);
    schema.clone_into(&mut log.topics[place].schema);
    for row in rows {
        let bytes: Vec<u8> = row[1..].iter().flat_map(|v| v.to_le_bytes()).collect();
        log.topics[place].push(row[0], &bytes);
    }
}

#[test]
fn what_a_receiver_writes_without_a_fix_is_no_place_height_or_velocity() {
    let mut text = "FMT, 1, 50, GPS, QBLLfff, TimeUS,Status,Lat,Lng,Alt,Spd,GCrs\n".to_owned();
    // Two seconds without a fix, one of two dimensions, two whole ones.
    for (second, fix) in [1, 1, 2, 3, 3].into_iter().enumerate() {
        let known = if fix > 1 { "47.5, 8.5" } else { "0.0, 0.0" };
        let height = if fix > 2 { 600.0 } else { 0.0 };
        let speed = if fix > 1 { 20.0 } else { 0.0 };
        writeln!(
            text,
            "GPS, {second}000000, {fix}, {known}, {height}, {speed}, 90"
        )
        .unwrap();
    }
    let log = text_log(&text);
    let times = |role| series(&log, role).unwrap().times;
    assert_eq!(times(Role::Latitude), [2.0, 3.0, 4.0]);
    assert_eq!(times(Role::GpsVelocityEast), [2.0, 3.0, 4.0]);
    assert_eq!(times(Role::GroundSpeed), [2.0, 3.0, 4.0]);
    let height = series(&log, Role::GpsHeight).unwrap();
    assert_eq!(
        (height.times, height.values),
        (vec![3.0, 4.0], vec![600.0; 2])
    );
    assert_eq!(times(Role::GpsFix).len(), 5);
}

#[test]
fn heights_above_ground_count_where_the_sensor_knows_them_and_looks_down() {
    let log = text_log(
        "FMT, 1, 50, TERR, QBf, TimeUS,Status,CHeight\nTERR, 1000000, 1, 0\nTERR, 2000000, 2, 80\nTERR, 3000000, 2, 81\n",
    );
    let height = series(&log, Role::HeightAboveGround).unwrap();
    assert_eq!(height.values, [80.0, 81.0]);
    let mut log = Log::new("a.ulg", LogFormat::Ulog);
    let bottom = ["dist_bottom", "dist_bottom_valid"];
    let rows = [vec![0.0, 0.1, 0.0], vec![1.0, 0.2, 0.0]];
    with(&mut log, "vehicle_local_position", "", &bottom, &rows);
    let range = ["current_distance", "orientation"];
    let rows = [vec![0.0, 3.0, 0.0], vec![1.0, 4.0, 0.0]];
    with(&mut log, "distance_sensor", "", &range, &rows);
    assert_eq!(series(&log, Role::HeightAboveGround), None);
    let rows = [vec![2.0, 30.0, 25.0], vec![3.0, 31.0, 25.0]];
    with(&mut log, "distance_sensor", "", &range, &rows);
    let height = series(&log, Role::HeightAboveGround).unwrap();
    assert_eq!(height.values, [30.0, 31.0]);
    let rows = [vec![4.0, 28.0, 1.0], vec![5.0, 29.0, 1.0]];
    with(&mut log, "vehicle_local_position", "", &bottom, &rows);
    let height = series(&log, Role::HeightAboveGround).unwrap();
    assert_eq!(height.values, [28.0, 29.0]);
}

#[test]
fn a_height_before_the_autopilot_has_an_origin_is_none() {
    let mut log = Log::new("a.tlog", LogFormat::Tlog);
    let (mut hud, mut gps) = (Vec::new(), Vec::new());
    for second in 0..400 {
        let (time, is_up) = (f64::from(second), (120..300).contains(&second));
        let height = if is_up { 620.0 } else { 584.0 };
        hud.push(vec![time, if second < 30 { 0.0 } else { height }]);
        gps.push(vec![time, 3.0, 475_000_000.0, 85_000_000.0, 0.0, 0.0]);
    }
    with(&mut log, "VFR_HUD", "", &["alt"], &hud);
    let fields = ["fix_type", "lat", "lon", "vel", "cog"];
    with(&mut log, "GPS_RAW_INT", "", &fields, &gps);
    let found = flight_from_log(&log).found;
    let height = found.iter().find(|s| s.role == Role::BarometricHeight);
    let height = height.unwrap();
    assert_eq!((height.times[0], height.values[0]), (30.0, 584.0));
    // It stands until 120 s, and from 300 s on.
    let flown = crate::overview::airborne(&found);
    assert_eq!(flown.len(), 1, "{flown:?}");
    assert!(
        (flown[0].0 - 120.0).abs() < 2.0 && (flown[0].1 - 300.0).abs() < 2.0,
        "{flown:?}"
    );
    // Heights that begin at nought and climb are measured.
    let mut log = Log::new("a.tlog", LogFormat::Tlog);
    let climb = |i: i32| vec![f64::from(i), 3.0 * f64::from((i - 9).max(0))];
    let rows: Vec<_> = (0..40).map(climb).collect();
    with(&mut log, "VFR_HUD", "", &["alt"], &rows);
    assert_eq!(
        series(&log, Role::BarometricHeight).unwrap().times.len(),
        40
    );
}

#[test]
fn velocities_that_the_receiver_calls_invalid_are_none() {
    let mut log = Log::new("a.ulg", LogFormat::Ulog);
    let fields = ["fix_type", "vel_n_m_s", "vel_ned_valid"];
    let rows = [vec![0.0, 3.0, 0.0, 0.0], vec![1.0, 3.0, 12.0, 1.0]];
    with(&mut log, "sensor_gps", "", &fields, &rows);
    let velocity = series(&log, Role::GpsVelocityNorth).unwrap();
    assert_eq!(velocity.values, [12.0]);
}

#[test]
fn the_wind_of_old_filters_is_in_metres_a_second() {
    // The letter `c` has the hundredths: ArduPilot 3.1 writes (int16_t)(100 * wind.x).
    let log = text_log(
        "FMT, 1, 25, EKF2, Icc, TimeMS,VWN,VWE\nEKF2, 1000, 4.00, -3.00\nEKF2, 2000, 4.10, -3.00\n",
    );
    let wind = |role| series(&log, role).unwrap().values[0];
    assert!((wind(Role::WindNorth) - 4.0).abs() < 1e-9);
    assert!((wind(Role::WindEast) + 3.0).abs() < 1e-9);
}

#[test]
fn logs_of_px4_from_before_ulog_are_read_in_radians() {
    let log = text_log(
        "FMT, 1, 50, TIME, Q, StartTime\nFMT, 2, 50, ATT, fffffff, qw,qx,qy,qz,Roll,Pitch,Yaw\n\
         FMT, 3, 50, GPS, QBLLffff, GPSTime,Fix,Lat,Lon,Alt,VelN,VelE,VelD\n\
         TIME, 1000000\nATT, 0.70710678, 0, 0, 0.70710678, 0, 0, 1.5708\nGPS, 1400000000000000, 3, 47.5, 8.5, 600, 1, 2, 3\n\
         TIME, 2000000\nATT, 0.70710678, 0.01, 0, 0.70710678, 0, 0, 1.5708\nGPS, 1400000001000000, 3, 47.6, 8.6, 601, 1, 2, 3\n",
    );
    let heading = series(&log, Role::Heading).unwrap();
    assert!((heading.values[0] - std::f64::consts::FRAC_PI_2).abs() < 1e-6);
    assert!((series(&log, Role::Longitude).unwrap().values[0].to_degrees() - 8.5).abs() < 1e-6);
    assert_eq!(
        series(&log, Role::GpsVelocityEast).unwrap().values,
        [2.0; 2]
    );
}

#[test]
fn text_logs_with_decimal_commas_are_read() {
    let log = text_log(
        "FMT, 1, 50, GPS, QBLLf, TimeUS,Status,Lat,Lng,Alt\nGPS, 1000000, 3, 47,5123456, -8,25, 600,5\nGPS, 2000000, 3, 47,5123457, -8,25, 1,2E+03\n",
    );
    assert_eq!(log.report.skipped_bytes, 0);
    let values = |role| series(&log, role).unwrap().values;
    assert!((values(Role::Latitude)[0].to_degrees() - 47.512_345_6).abs() < 1e-9);
    assert!((values(Role::Longitude)[0].to_degrees() + 8.25).abs() < 1e-9);
    assert_eq!(values(Role::GpsHeight), [600.5, 1200.0]);
}

#[test]
fn a_place_at_nought_north_and_nought_east_is_none_whatever_the_format() {
    let mut log = Log::new("a.mcap", LogFormat::Mcap);
    let fields = ["latitude", "longitude", "altitude"];
    let rows = [
        vec![0.0, 0.0, 0.0, 0.0],
        vec![1.0, 47.5, 8.5, 600.0],
        vec![2.0, 0.0, 8.5, 601.0],
    ];
    with(&mut log, "/loc", "foxglove.LocationFix", &fields, &rows);
    // The equator is a place.
    assert_eq!(series(&log, Role::Latitude).unwrap().times, [1.0, 2.0]);
    assert_eq!(
        series(&log, Role::GpsHeight).unwrap().values,
        [600.0, 601.0]
    );
}

#[test]
fn of_two_receivers_that_is_taken_which_knows_its_place_more_often() {
    let mut text = "FMT, 1, 50, GPS, QBLLf, TimeUS,Status,Lat,Lng,Alt\nFMT, 2, 50, GPS2, QBLLf, TimeUS,Status,Lat,Lng,Alt\n".to_owned();
    for second in 0..10 {
        // The first loses it in the middle of the flight.
        let fix = if second < 5 { 3 } else { 1 };
        writeln!(text, "GPS, {second}000000, {fix}, 47.{second}, 8.5, 600").unwrap();
        writeln!(text, "GPS2, {second}000000, 3, 47.{second}, 8.5, 610").unwrap();
    }
    let log = text_log(&text);
    let latitude = series(&log, Role::Latitude).unwrap();
    assert_eq!(
        (latitude.source.as_str(), latitude.times.len()),
        ("GPS2.Lat", 10)
    );
    assert_eq!(series(&log, Role::GpsHeight).unwrap().values, [610.0; 10]);
}

#[test]
fn airspeeds_of_a_sensor_that_is_not_healthy_are_none() {
    let log = text_log(
        "FMT, 1, 50, ARSP, QfB, TimeUS,Airspeed,H\nARSP, 1000000, 0.4, 0\nARSP, 2000000, 18.0, 1\nARSP, 3000000, 18.5, 1\n",
    );
    assert_eq!(series(&log, Role::Airspeed).unwrap().values, [18.0, 18.5]);
}

#[test]
fn weeks_that_an_old_receiver_counts_again_from_nought_are_of_this_time() {
    // Week 2300 began on 4 February 2024; the receiver says 1024 fewer.
    let log = text_log(
        "FMT, 1, 50, GPS, QBIHLL, TimeUS,Status,GMS,GWk,Lat,Lng\nGPS, 1000000, 3, 1000, 1276, 47.0, 8.0\nGPS, 2000000, 3, 2000, 1276, 47.1, 8.0\n",
    );
    let date = log.utc_at_zero.unwrap();
    assert_eq!(date, 1_707_004_800.0 - 18.0);
    assert!(
        log.report
            .remarks
            .iter()
            .any(|remark| remark.contains("1024 weeks"))
    );
}

#[test]
fn heights_of_receivers_that_know_no_fix_above_two_count_with_that() {
    let mut text = "FMT, 1, 50, GPS, QBLLf, TimeUS,Status,Lat,Lng,Alt\n".to_owned();
    // GPS_OK of old ArduPilot is 2.
    for (second, fix) in [1, 2, 2].into_iter().enumerate() {
        writeln!(text, "GPS, {second}000000, {fix}, 47.5, 8.5, 60{second}").unwrap();
    }
    let height = series(&text_log(&text), Role::GpsHeight).unwrap();
    assert_eq!(height.values, [601.0, 602.0]);
}

#[test]
fn a_receiver_is_not_preferred_for_its_rate() {
    let mut text = "FMT, 1, 50, GPS, QBLLf, TimeUS,Status,Lat,Lng,Alt\nFMT, 2, 50, GPS2, QBLLf, TimeUS,Status,Lat,Lng,Alt\n".to_owned();
    for i in 0..80 {
        if i % 2 == 0 {
            writeln!(text, "GPS, {}, 3, 47.{i:02}, 8.5, 600", 125_000 * i).unwrap();
        }
        writeln!(text, "GPS2, {}, 3, 47.{i:02}, 8.5, 610", 125_000 * i).unwrap();
    }
    let latitude = series(&text_log(&text), Role::Latitude).unwrap();
    assert_eq!(latitude.source, "GPS.Lat");
}

#[test]
fn range_sensors_of_the_first_years_of_ulog_look_down_where_none_says_so_otherwise() {
    let mut log = Log::new("a.ulg", LogFormat::Ulog);
    let range = ["current_distance", "orientation"];
    let rows = [
        vec![0.0, 3.0, 8.0],
        vec![1.0, 4.0, 8.0],
        vec![2.0, 9.0, 0.0],
    ];
    with(&mut log, "distance_sensor", "", &range, &rows);
    let height = series(&log, Role::HeightAboveGround).unwrap();
    assert_eq!(height.values, [3.0, 4.0]);
    let rows = [vec![3.0, 30.0, 25.0], vec![4.0, 31.0, 25.0]];
    with(&mut log, "distance_sensor", "", &range, &rows);
    let height = series(&log, Role::HeightAboveGround).unwrap();
    assert_eq!(height.values, [30.0, 31.0]);
}

#[test]
fn a_speed_over_ground_counts_whether_or_not_its_direction_is_valid() {
    let mut log = Log::new("a.ulg", LogFormat::Ulog);
    let fields = ["fix_type", "vel_m_s", "vel_d_m_s", "vel_ned_valid"];
    let rows = [vec![0.0, 3.0, 5.0, 1.0, 0.0], vec![1.0, 3.0, 6.0, 2.0, 0.0]];
    with(&mut log, "vehicle_gps_position", "", &fields, &rows);
    let speed = series(&log, Role::GroundSpeed).unwrap();
    assert_eq!(speed.values, [5.0, 6.0]);
    assert_eq!(series(&log, Role::GpsVelocityDown), None);
}

#[test]
fn the_first_logs_of_px4_are_read_in_radians_without_a_quaternion() {
    let log = text_log(
        "FMT, 1, 50, TIME, Q, StartTime\nFMT, 2, 50, ATT, ffffff, Roll,Pitch,Yaw,RollRate,PitchRate,YawRate\n\
         TIME, 1000000\nATT, 0.1, -0.2, 1.5, 0, 0, 0\nTIME, 2000000\nATT, 0.2, -0.1, 1.6, 0, 0, 0\n",
    );
    for (role, expected) in [
        (Role::Roll, [0.1, 0.2]),
        (Role::Pitch, [-0.2, -0.1]),
        (Role::Heading, [1.5, 1.6]),
    ] {
        let found = series(&log, role).unwrap().values;
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{role:?}: {found}");
        }
    }
}
