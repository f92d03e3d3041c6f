//! Rows that were not measured, topics that tell of something else, and units of old and of stated numbers.

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
fn with(log: &mut Log, name: &str, schema: &str, fields: &[&str], rows: &[Vec<f64>]) {
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
fn setpoints_and_cameras_of_ros_are_not_the_vehicle() {
    let mut log = Log::new("a.mcap", LogFormat::Mcap);
    let pose = ["x", "y", "z", "w"].map(|part| format!("pose.orientation.{part}"));
    let pose: Vec<&str> = pose.iter().map(String::as_str).collect();
    // East, and north, of ROS.
    let (east, north) = (
        [0.0, 0.0, 0.0, 1.0],
        [0.0, 0.0, 0.5_f64.sqrt(), 0.5_f64.sqrt()],
    );
    let kind = "geometry_msgs/msg/PoseStamped";
    let row = |time: f64, turn: [f64; 4]| [&[time][..], &turn].concat();
    let wanted = [row(0.0, east), row(1.0, north)];
    with(
        &mut log,
        "/mavros/setpoint_position/local",
        kind,
        &pose,
        &wanted,
    );
    assert_eq!(series(&log, Role::Heading), None);
    let flown = [row(0.0, north), row(1.0, east)];
    with(&mut log, "/mavros/local_position/pose", kind, &pose, &flown);
    let heading = series(&log, Role::Heading).unwrap();
    assert!(heading.values[0].abs() < 1e-9, "{heading:?}");
    let kind = "sensor_msgs/msg/Imu";
    let force = ["linear_acceleration.z"];
    with(
        &mut log,
        "/camera/imu",
        kind,
        &force,
        &[vec![0.0, 0.1], vec![1.0, 0.2]],
    );
    assert_eq!(series(&log, Role::AccelerationDown), None);
    with(
        &mut log,
        "/imu/data",
        kind,
        &force,
        &[vec![0.0, 9.8], vec![1.0, 9.7]],
    );
    assert_eq!(
        series(&log, Role::AccelerationDown).unwrap().values,
        [-9.8, -9.7]
    );
}

#[test]
fn a_fix_of_which_the_driver_says_nothing_counts() {
    let mut log = Log::new("a.mcap", LogFormat::Mcap);
    let fields = ["status.status", "latitude", "longitude", "altitude"];
    // STATUS_UNKNOWN, then STATUS_NO_FIX.
    let rows = [
        vec![0.0, -2.0, 47.5, 8.5, 600.0],
        vec![1.0, -1.0, 0.0, 0.0, 0.0],
    ];
    with(
        &mut log,
        "/fix",
        "sensor_msgs/msg/NavSatFix",
        &fields,
        &rows,
    );
    let found: Vec<RoleSeries> = [Role::Latitude, Role::Longitude, Role::GpsHeight]
        .into_iter()
        .filter_map(|role| series(&log, role))
        .collect();
    let places = places(&found, Navigation::Gps);
    assert_eq!(places.len(), 1);
    assert!((places[0].1.latitude.to_degrees() - 47.5).abs() < 1e-9);
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
fn the_vehicles_of_a_recording_of_ros_are_not_mixed() {
    let mut log = Log::new("a.mcap", LogFormat::Mcap);
    let (fix, imu) = ("sensor_msgs/msg/NavSatFix", "sensor_msgs/msg/Imu");
    let rate = ["angular_velocity.x"];
    with(
        &mut log,
        "/uav1/imu",
        imu,
        &rate,
        &[vec![0.0, 1.0], vec![1.0, 1.1]],
    );
    with(
        &mut log,
        "/uav2/imu",
        imu,
        &rate,
        &[vec![0.0, 2.0], vec![1.0, 2.2]],
    );
    let place = ["latitude", "longitude"];
    with(
        &mut log,
        "/uav2/fix",
        fix,
        &place,
        &[vec![0.0, 48.0, 8.0], vec![1.0, 48.1, 8.0]],
    );
    with(
        &mut log,
        "/uav1/fix",
        fix,
        &place,
        &[vec![0.0, 47.0, 8.0], vec![1.0, 47.1, 8.0]],
    );
    assert_eq!(
        series(&log, Role::RollRate).unwrap().source,
        "/uav2/imu.angular_velocity.x"
    );
    assert_eq!(
        series(&log, Role::Latitude).unwrap().source,
        "/uav2/fix.latitude"
    );
    assert_eq!(log.vehicles_by_name(), ["uav2", "uav1"]);
}

#[test]
fn an_imu_whose_third_axis_is_down_is_not_of_the_axes_of_ros() {
    let mut log = Log::new("a.mcap", LogFormat::Mcap);
    let fields = [
        "orientation.x",
        "orientation.y",
        "orientation.z",
        "orientation.w",
        "angular_velocity.z",
        "linear_acceleration.y",
        "linear_acceleration.z",
    ];
    // A heading of 90° counted from north, which of ROS would be 0°.
    let half = 0.5_f64.sqrt();
    let row = |time: f64| {
        vec![
            time,
            0.0,
            0.0,
            half,
            half,
            0.2 + time,
            0.5 + time,
            -9.8 + 0.1 * time,
        ]
    };
    with(
        &mut log,
        "/imu",
        "sensor_msgs/msg/Imu",
        &fields,
        &[row(0.0), row(1.0)],
    );
    let first = |role| series(&log, role).unwrap().values[0];
    assert!((first(Role::Heading) - std::f64::consts::FRAC_PI_2).abs() < 1e-9);
    assert_eq!(first(Role::YawRate), 0.2);
    assert_eq!(first(Role::AccelerationRight), 0.5);
    assert_eq!(first(Role::AccelerationDown), -9.8);
    let source = series(&log, Role::YawRate).unwrap().source;
    assert!(source.contains("as gravity says"), "{source}");
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
fn forces_in_multiples_of_gravity_and_pressures_in_hectopascals_are_known_by_their_amounts() {
    let mut log = Log::new("a.mcap", LogFormat::Mcap);
    let fields = [
        "linear_acceleration.x",
        "linear_acceleration.y",
        "linear_acceleration.z",
        "angular_velocity.x",
    ];
    // As the IMU of a Livox is written.
    let rows = [
        vec![0.0, 0.1, 0.2, 0.99, 0.5],
        vec![1.0, 0.1, 0.2, 0.98, 0.6],
    ];
    with(
        &mut log,
        "/livox/imu",
        "sensor_msgs/msg/Imu",
        &fields,
        &rows,
    );
    let first = |role| series(&log, role).unwrap().values[0];
    assert!((first(Role::AccelerationDown) + 0.99 * 9.806_65).abs() < 1e-9);
    assert!((first(Role::AccelerationRight) + 0.2 * 9.806_65).abs() < 1e-9);
    assert_eq!(first(Role::RollRate), 0.5);
    // Forces without gravity are what they are.
    let mut bare = Log::new("b.mcap", LogFormat::Mcap);
    let rows = [
        vec![0.0, 0.9, 0.2, 0.1, 0.5],
        vec![1.0, -0.8, -0.3, 0.1, 0.6],
    ];
    with(&mut bare, "/imu", "sensor_msgs/msg/Imu", &fields, &rows);
    assert_eq!(
        series(&bare, Role::AccelerationForward).unwrap().values,
        [0.9, -0.8]
    );
    let pressure = [vec![0.0, 954.61], vec![1.0, 953.0]];
    with(
        &mut log,
        "/baro",
        "sensor_msgs/msg/FluidPressure",
        &["fluid_pressure"],
        &pressure,
    );
    // 954.61 hPa are 500 m in the standard atmosphere.
    let height = series(&log, Role::BarometricHeight).unwrap();
    assert!((height.values[0] - 500.0).abs() < 0.5, "{height:?}");
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
